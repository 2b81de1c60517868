// apps/unknown_words.h
//
// Explains words of a command line that name neither a command nor an option.

#pragma once

#include <CLI/CLI.hpp>

#include <span>
#include <string>

namespace penumbra {

// Returns a sentence about the first command or option on the command line that does not exist, with the name
// that the user probably meant; empty if all commands and options exist. `arguments` are the words of the
// command line behind the program's name.
std::string UnknownWord(const CLI::App& program, std::span<const std::string> arguments);

}  // namespace penumbra
