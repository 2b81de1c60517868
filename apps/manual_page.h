// apps/manual_page.h

#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace penumbra {

// The manual page of the program, or of one of its commands, in the format of man(1), made from the texts of
// --help. `version` is the program's version. Equal programs give equal manual pages.
std::string ProgramPage(const CLI::App& program, const std::string& version);
std::string CommandPage(const CLI::App& command, const std::string& version);

// The name of the manual page of a command: "penumbra-solve" for the command solve. A manual page with the
// name NAME is stored in a file called NAME.1.
std::string PageName(const CLI::App& command);

}  // namespace penumbra
