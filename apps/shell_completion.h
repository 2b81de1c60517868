// apps/shell_completion.h
//
// Makes scripts by which a shell completes the program's commands, options and values of options.

#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace penumbra {

// The permitted values of an option whose value is one of a fixed list of names; an empty list for other
// options.
std::vector<std::string> ChoicesOf(const CLI::Option& option);
// True if the option is followed by a value on the command line.
bool TakesValue(const CLI::Option& option);

// Returns the completion script for bash, which the user can source or put in a folder of bash-completion.
std::string BashCompletion(const CLI::App& program);
// Returns the completion script for zsh, to be stored as the file _penumbra in a folder of $fpath.
std::string ZshCompletion(const CLI::App& program);

}  // namespace penumbra
