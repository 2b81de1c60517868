// penumbra completion, penumbra manual-page: what shells and man(1) know of the program. Both are made from
// the options themselves, so that they never tell of others.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/manual_page.h"
#include "apps/output.h"
#include "apps/shell_completion.h"
#include "solver/base/whole_file.h"

namespace penumbra {
namespace {

constexpr const char* kPageVersion = "penumbra " PENUMBRA_VERSION;

struct PageArguments {
  std::string command;  // empty: the program
  std::optional<std::string> folder;
};

// The pages of the program and of all commands, in a folder that exists.
void WritePages(const CLI::App& program, const std::filesystem::path& folder) {
  WriteWholeFile(folder / "penumbra.1", ProgramPage(program, kPageVersion));
  for (const CLI::App* command : program.get_subcommands({}))
    WriteWholeFile(folder / (PageName(*command) + ".1"), CommandPage(*command, kPageVersion));
}

void WritePage(const CLI::App& program, const PageArguments& arguments) {
  if (arguments.folder) return WritePages(program, *arguments.folder);
  for (const CLI::App* command : program.get_subcommands({}))
    if (command->get_name() == arguments.command)
      return WriteResult(std::nullopt, CommandPage(*command, kPageVersion));
  if (!arguments.command.empty())
    throw UsageError(fmt::format("there is no command '{}'", arguments.command));
  WriteResult(std::nullopt, ProgramPage(program, kPageVersion));
}

}  // namespace

Command AddCompletionCommand(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("completion", "Print a script that completes commands and options in a shell");
  const auto shell = std::make_shared<std::string>();
  app->add_option("SHELL", *shell, "bash or zsh")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>{"bash", "zsh"}))
      ->type_name("");
  app->footer(
      "bash: source <(penumbra completion bash)\n"
      "zsh:  penumbra completion zsh > FOLDER/_penumbra, where FOLDER is in $fpath\n"
      "What `cmake --install` or the package installs needs neither.");
  return {app, [shell, &program] {
            WriteResult(std::nullopt, *shell == "bash" ? BashCompletion(program) : ZshCompletion(program));
          }};
}

Command AddManualPageCommand(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("manual-page", "Print the manual page of the program or of a command, for man");
  const auto arguments = std::make_shared<PageArguments>();
  CLI::Option* command =
      app->add_option("COMMAND", arguments->command, "The command; without it, the program")->type_name("");
  app->add_option("--folder", arguments->folder, "Write all pages into this folder")
      ->type_name("FOLDER")
      ->excludes(command);
  app->footer("penumbra manual-page solve | man -l -");
  return {app, [arguments, &program] { WritePage(program, *arguments); }};
}

}  // namespace penumbra
