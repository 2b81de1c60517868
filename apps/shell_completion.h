// apps/shell_completion.h
//
// Scripts that complete commands, options and their values in a shell.

#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace penumbra {

// The names that an option takes, if its value is one of a few; otherwise empty.
std::vector<std::string> ChoicesOf(const CLI::Option& option);
// True if a value follows the option.
bool TakesValue(const CLI::Option& option);

// The script for bash, to be sourced, or put where bash-completion looks.
std::string BashCompletion(const CLI::App& program);
// The script for zsh, as the file _penumbra in a folder of $fpath.
std::string ZshCompletion(const CLI::App& program);

}  // namespace penumbra
