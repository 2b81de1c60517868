#include "apps/manual_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "apps/shell_completion.h"
#include "mesh/pipeline/option_table.h"

namespace penumbra {
namespace {

// The group of options that CLI11 makes of those without one.
constexpr const char* kPlainGroup = "Options";

// The text as roff shows it: a backslash, a hyphen that can be copied, and no request at the beginning of a
// line.
std::string RoffText(const std::string& text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins_line = i == 0 || text[i - 1] == '\n';
    if (begins_line && (text[i] == '.' || text[i] == '\'')) escaped += "\\&";
    if (text[i] == '\\')
      escaped += "\\e";
    else if (text[i] == '-')
      escaped += "\\-";
    else
      escaped += text[i];
  }
  return escaped;
}

std::string UpperCase(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::string PageTitle(const std::string& name, const std::string& version) {
  return fmt::format(".TH {} 1 \"\" \"{}\" \"Penumbra\"\n", UpperCase(name), RoffText(version));
}

// A line of words in a paragraph, as it was laid out.
std::string AsLaidOut(const std::string& text) { return ".nf\n" + RoffText(text) + "\n.fi\n"; }

// "-o, --output FILE", with the option bold and the value in italics.
std::string OptionTerm(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("\\fB" + RoffText("-" + name) + "\\fR");
  for (const std::string& name : option.get_lnames())
    names.push_back("\\fB" + RoffText("--" + name) + "\\fR");
  std::string term = fmt::format("{}", fmt::join(names, ", "));
  if (TakesValue(option) && !option.get_type_name().empty())
    term += " \\fI" + RoffText(option.get_type_name()) + "\\fR";
  return term;
}

std::string OptionEntry(const CLI::Option& option) {
  std::string entry = ".TP\n" + OptionTerm(option) + "\n" + RoffText(option.get_description());
  if (TakesValue(option) && !option.get_default_str().empty())
    entry += " (default: " + RoffText(option.get_default_str()) + ")";
  return entry + "\n";
}

// The values of options that serve only to compare methods.
std::string StudyEntries(const CLI::App& command) {
  std::string entries;
  for (const SolveOption& option : OptionTable()) {
    if (!command.get_option_no_throw(CommandLineName(option))) continue;
    for (const StudyChoice& choice : option.study_choices)
      entries += fmt::format(".TP\n\\fB{}\\fR {}\n{}\n", RoffText(CommandLineName(option)),
                             RoffText(choice.name), RoffText(choice.help));
  }
  return entries;
}

// All options that are no positions, group by group in the order of the first option of each.
std::string OptionSections(const CLI::App& command) {
  std::vector<std::string> groups;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_positional() &&
        std::find(groups.begin(), groups.end(), option->get_group()) == groups.end())
      groups.push_back(option->get_group());
  std::string text = ".SH OPTIONS\n";
  for (const std::string& group : groups) {
    if (group != kPlainGroup) text += ".SS " + RoffText(group) + "\n";
    for (const CLI::Option* option : command.get_options())
      if (!option->get_positional() && option->get_group() == group) text += OptionEntry(*option);
    if (group == GroupTitle(OptionGroup::kStudies)) text += StudyEntries(command);
  }
  return text;
}

}  // namespace

std::string PageName(const CLI::App& command) { return "penumbra-" + command.get_name(); }

std::string CommandPage(const CLI::App& command, const std::string& version) {
  std::string positions, described;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    const bool is_list = option->get_items_expected_max() > 1;
    positions += fmt::format(" \\fI{}\\fR{}", RoffText(option->get_name(true)), is_list ? "..." : "");
    described += fmt::format(".TP\n\\fI{}\\fR\n{}\n", RoffText(option->get_name(true)),
                             RoffText(option->get_description()));
  }
  std::string page = PageTitle(PageName(command), version);
  page +=
      fmt::format(".SH NAME\n{} \\- {}\n", RoffText(PageName(command)), RoffText(command.get_description()));
  page += fmt::format(".SH SYNOPSIS\n\\fBpenumbra {}\\fR{} [\\fIOPTIONS\\fR]\n", RoffText(command.get_name()),
                      positions);
  if (!described.empty()) page += ".SH ARGUMENTS\n" + described;
  page += OptionSections(command);
  if (!command.get_footer().empty()) page += ".SH NOTES\n" + AsLaidOut(command.get_footer());
  return page + ".SH SEE ALSO\n\\fBpenumbra\\fR(1)\n";
}

std::string ProgramPage(const CLI::App& program, const std::string& version) {
  std::string page = PageTitle("penumbra", version);
  page += ".SH NAME\npenumbra \\- compute the light in a scene of diffuse polygons\n";
  page += ".SH SYNOPSIS\n\\fBpenumbra\\fR \\fICOMMAND\\fR [\\fIARGUMENTS\\fR]\n";
  page += ".SH DESCRIPTION\n" + RoffText(program.get_description()) + "\n.SH COMMANDS\n";
  std::vector<std::string> pages;
  for (const CLI::App* command : program.get_subcommands({})) {
    page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", RoffText(command->get_name()),
                        RoffText(command->get_description()));
    pages.push_back(fmt::format("\\fB{}\\fR(1)", RoffText(PageName(*command))));
  }
  page += OptionSections(program) + ".SH NOTES\n" + AsLaidOut(program.get_footer());
  return page + fmt::format(".SH SEE ALSO\n{}\n", fmt::join(pages, ",\n"));
}

}  // namespace penumbra
