// apps/manual_page.h

#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace penumbra {

// The manual page of the program, or of one of its commands, for man(1), from what --help tells. `version` is
// that of the program. Equal programs give equal pages.
std::string ProgramPage(const CLI::App& program, const std::string& version);
std::string CommandPage(const CLI::App& command, const std::string& version);

// The name of the page: "penumbra-solve" for the command solve. The file is PAGE.1.
std::string PageName(const CLI::App& command);

}  // namespace penumbra
