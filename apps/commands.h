// apps/commands.h
//
// The commands of the program. Each of the functions AddSolveCommand() to AddManualPageCommand() adds a
// command and its options to the command line and returns the command.

#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <stdexcept>

namespace penumbra {

// The exception for an error of the command line that is detected after the command line has been parsed, for
// example an option that does not fit the scene. After a UsageError, the exit status is 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The exception thrown if the user has interrupted the work. After an interrupt, the exit status is 130, and
// no output is written.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted; nothing was written") {}
};

struct Command {
  // The parser of the command's options, which converts to true if the user has given the command.
  CLI::App* app = nullptr;
  std::function<void()> run;  // runs the command; throws InputError, UsageError, Interrupted
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
Command AddMethodsCommand(CLI::App& program);
Command AddGridCommand(CLI::App& program);
Command AddCompletionCommand(CLI::App& program);
Command AddManualPageCommand(CLI::App& program);

}  // namespace penumbra
