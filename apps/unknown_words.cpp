#include "apps/unknown_words.h"

#include <fmt/format.h>

#include <vector>

#include "solver/base/similar_names.h"

namespace penumbra {
namespace {

// The names of all long options, with their dashes.
std::vector<std::string> LongOptions(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// The command with this name; null if there is none.
const CLI::App* FindCommand(const CLI::App& program, const std::string& name) {
  for (const CLI::App* command : program.get_subcommands({}))
    if (command->get_name() == name) return command;
  return nullptr;
}

std::string UnknownOption(const CLI::App& app, const std::string& argument) {
  const std::string name = argument.substr(0, argument.find('='));
  if (app.get_option_no_throw(name)) return "";
  const std::string command =
      app.get_parent() ? app.get_parent()->get_name() + " " + app.get_name() : app.get_name();
  return fmt::format("there is no option {} of `{}`{}", name, command, DidYouMean(name, LongOptions(app)));
}

}  // namespace

std::string UnknownWord(const CLI::App& program, std::span<const std::string> arguments) {
  const CLI::App* app = &program;
  for (const std::string& argument : arguments) {
    if (argument == "--") break;
    if (argument.starts_with("--")) {
      const std::string error = UnknownOption(*app, argument);
      if (!error.empty()) return error;
    } else if (app == &program && !argument.starts_with("-")) {
      app = FindCommand(program, argument);
      if (app) continue;
      std::vector<std::string> names;
      for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
      return fmt::format("there is no command '{}'{}", argument, DidYouMean(argument, names));
    }
  }
  return "";
}

}  // namespace penumbra
