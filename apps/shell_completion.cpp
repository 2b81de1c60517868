#include "apps/shell_completion.h"

#include <fmt/format.h>

#include <algorithm>

#include "solver/scene/builtin_scenes.h"

namespace penumbra {
namespace {

// The option as it is written on the command line: -s and --long.
std::vector<std::string> Spellings(const CLI::Option& option) {
  std::vector<std::string> spellings;
  for (const std::string& name : option.get_snames()) spellings.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) spellings.push_back("--" + name);
  return spellings;
}

std::string SceneNames() {
  std::vector<std::string> names;
  for (const BuiltinScene& scene : BuiltinScenes()) names.push_back(scene.name);
  return fmt::format("{}", fmt::join(names, " "));
}

bool TakesScene(const CLI::App& command) { return command.get_option_no_throw("SCENE") != nullptr; }

// The lines of a case of bash for each option of a command whose value is one of a few names.
std::string BashChoices(const CLI::App& command) {
  std::string lines;
  for (const CLI::Option* option : command.get_options()) {
    const std::vector<std::string> choices = ChoicesOf(*option);
    if (choices.empty()) continue;
    std::vector<std::string> patterns;
    for (const std::string& spelling : Spellings(*option))
      patterns.push_back(command.get_name() + "/" + spelling);
    lines += fmt::format("    {}) words=\"{}\" ;;\n", fmt::join(patterns, "|"), fmt::join(choices, " "));
  }
  return lines;
}

// The patterns of options that take any value, of all commands, for a case of bash.
std::string BashValues(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> patterns;
  for (const CLI::App* command : commands)
    for (const CLI::Option* option : command->get_options())
      if (TakesValue(*option) && ChoicesOf(*option).empty())
        for (const std::string& spelling : Spellings(*option))
          patterns.push_back(command->get_name() + "/" + spelling);
  return fmt::format("{}", fmt::join(patterns, "|"));
}

// The text within the quotation marks and brackets of a specification of zsh's _arguments.
std::string ZshText(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\'')
      escaped += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      escaped += fmt::format("\\{}", c);
    else
      escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

std::string ZshOptions(const CLI::App& command) {
  std::string specifications;
  for (const CLI::Option* option : command.get_options()) {
    const std::string help = ZshText(option->get_description());
    const std::vector<std::string> choices = ChoicesOf(*option);
    for (const std::string& spelling : Spellings(*option)) {
      std::string value;
      if (!choices.empty())
        value = fmt::format(":value:({})", fmt::join(choices, " "));
      else if (TakesValue(*option))
        value = fmt::format(":{}:_files", ZshText(option->get_type_name()));
      specifications += fmt::format(" \\\n        '{}[{}]{}'", spelling, help, value);
    }
  }
  if (TakesScene(command))
    specifications +=
        " \\\n        '*:scene:_alternative \"files:file:_files\" \"scenes:built-in scene:($scenes)\"'";
  return specifications;
}

}  // namespace

std::vector<std::string> ChoicesOf(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '|';
  };
  if (type.find('|') == type.npos || !std::all_of(type.begin(), type.end(), is_plain)) return {};
  std::vector<std::string> choices;
  for (std::size_t at = 0; at <= type.size();) {
    const std::size_t bar = std::min(type.find('|', at), type.size());
    choices.push_back(type.substr(at, bar - at));
    at = bar + 1;
  }
  return choices;
}

bool TakesValue(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

std::string BashCompletion(const CLI::App& program) {
  const std::vector<const CLI::App*> commands = program.get_subcommands({});
  std::vector<std::string> names, takers;
  std::string choices, options;
  for (const CLI::App* command : commands) {
    names.push_back(command->get_name());
    if (TakesScene(*command)) takers.push_back(command->get_name());
    choices += BashChoices(*command);
    std::vector<std::string> spellings;
    for (const CLI::Option* option : command->get_options())
      for (const std::string& spelling : Spellings(*option)) spellings.push_back(spelling);
    options += fmt::format("      {}) words=\"{}\" ;;\n", command->get_name(), fmt::join(spellings, " "));
  }
  return fmt::format(
      "# Completion of penumbra for bash; made by `penumbra completion bash`.\n"
      "_penumbra() {{\n"
      "  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} "
      "command=${{COMP_WORDS[1]}}\n"
      "  local words=\"\" files=\"\"\n"
      "  COMPREPLY=()\n"
      "  if ((COMP_CWORD == 1)); then\n"
      "    COMPREPLY=($(compgen -W \"{} --help --version\" -- \"$current\"))\n"
      "    return\n"
      "  fi\n"
      "  case $command/$previous in\n{}"
      "    {}) return ;;  # any value: bash completes files\n"
      "  esac\n"
      "  if [[ -z $words && $current == -* ]]; then\n"
      "    case $command in\n{}"
      "    esac\n"
      "  elif [[ -z $words ]]; then\n"
      "    files=yes\n"
      "    case $command in\n"
      "      {}) words=\"{}\" ;;\n"
      "    esac\n"
      "  fi\n"
      "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
      "  [[ -z $files ]] || COMPREPLY+=($(compgen -f -- \"$current\"))\n"
      "}}\n"
      "complete -o filenames -o bashdefault -o default -F _penumbra penumbra\n",
      fmt::join(names, " "), choices, BashValues(commands), options, fmt::join(takers, "|"), SceneNames());
}

std::string ZshCompletion(const CLI::App& program) {
  std::string commands, cases;
  for (const CLI::App* command : program.get_subcommands({})) {
    commands += fmt::format("    '{}:{}'\n", command->get_name(), ZshText(command->get_description()));
    cases +=
        fmt::format("    {})\n      _arguments{}\n      ;;\n", command->get_name(), ZshOptions(*command));
  }
  return fmt::format(
      "#compdef penumbra\n"
      "# Completion of penumbra for zsh; made by `penumbra completion zsh`.\n"
      "_penumbra() {{\n"
      "  local -a commands scenes\n"
      "  commands=(\n{}  )\n"
      "  scenes=({})\n"
      "  if ((CURRENT == 2)); then\n"
      "    _describe command commands\n"
      "    return\n"
      "  fi\n"
      "  shift words\n"
      "  ((CURRENT--))\n"
      "  case $words[1] in\n{}"
      "  esac\n"
      "}}\n"
      "_penumbra \"$@\"\n",
      commands, SceneNames(), cases);
}

}  // namespace penumbra
