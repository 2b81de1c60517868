// apps/unknown_words.h
//
// Explains words of a command line that name neither a command nor an option.

#pragma once

#include <CLI/CLI.hpp>

#include <span>
#include <string>

namespace penumbra {

// A sentence about the first command or option of the command line that does not exist, with what was
// probably meant; empty if all exist. `arguments` are the words behind the program's name.
std::string UnknownWord(const CLI::App& program, std::span<const std::string> arguments);

}  // namespace penumbra
