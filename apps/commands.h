// apps/commands.h
//
// The commands of the program: each adds its options to the command line and comes back with what it does.

#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <stdexcept>

namespace penumbra {

// The command line asks for something that cannot be, which only shows once the scene is there: exit
// status 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The user interrupted the work: exit status 130, nothing written.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted; nothing was written") {}
};

struct Command {
  CLI::App* app = nullptr;    // true once the command was given
  std::function<void()> run;  // throws InputError, UsageError, Interrupted
};

Command AddSolveCommand(CLI::App& program);
Command AddRenderCommand(CLI::App& program);
Command AddProbeCommand(CLI::App& program);
Command AddFormFactorCommand(CLI::App& program);
Command AddViewCommand(CLI::App& program);
Command AddExportCommand(CLI::App& program);
Command AddDiffCommand(CLI::App& program);
Command AddInfoCommand(CLI::App& program);
Command AddScenesCommand(CLI::App& program);

}  // namespace penumbra
