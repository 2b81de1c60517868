// apps/commands.h
//
// The commands of the program. Each function adds a command's options to the command line and returns the
// command.

#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <stdexcept>

namespace penumbra {

// The command line is wrong in a way that only shows after the scene is read: exit status 2.
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
  CLI::App* app = nullptr;    // converts to true if the user gave the command
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
