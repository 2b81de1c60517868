#include "apps/solve_options.h"

#include <fmt/format.h>

#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "mesh/pipeline/option_table.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

// Help that lists choices which only studies make behind the options for studies.
class SolveHelp : public CLI::Formatter {
 public:
  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    const bool for_studies = group == GroupTitle(OptionGroup::kStudies);
    std::ostringstream out;
    out << CLI::Formatter::make_group(std::move(group), is_positional, std::move(options));
    if (!for_studies) return out.str();
    for (const SolveOption& option : OptionTable())
      for (const StudyChoice& choice : option.study_choices)
        CLI::detail::format_help(out, fmt::format("{} {}", CommandLineName(option), choice.name), choice.help,
                                 get_column_width());
    return out.str();
  }
};

// What stands behind the option's name in the help.
std::string TypeName(const SolveOption& option) {
  switch (option.field.kind) {
    case OptionKind::kNumber:
      return "X";
    case OptionKind::kInteger:
      return "N";
    case OptionKind::kChoice:
    case OptionKind::kFlag:
      break;
  }
  return fmt::format("{}", fmt::join(UsualChoices(option), "|"));
}

// REQUIRES: whoever chooses a solver has been heard. Options of the solver that holds by default are refused
// later, when all is known (CheckOptions).
void SetOption(const SolveOption& option, const OptionValue& value, PipelineOptions* solving) {
  if (!IsObeyed(option, *solving) && !IsObeyed(option, PipelineOptions()))
    throw CLI::ValidationError(
        CommandLineName(option),
        fmt::format("it is of {0}; give {1}, or leave it out", OwnersOf(option),
                    option.solver.empty() ? "one of these" : "--solver " + option.solver));
  option.field.set(value, solving);
}

void AddSolveOption(CLI::App& app, const SolveOption& option, PipelineOptions* solving) {
  const std::string name = CommandLineName(option), help = OptionHelp(option);
  // A command's own option has the name: --method of probe is about its points.
  if (app.get_option_no_throw(name)) return;
  const std::string group = GroupTitle(option.group);
  if (option.field.kind == OptionKind::kFlag) {
    app.add_flag_callback(
           name, [&option, solving] { SetOption(option, !option.flag_clears, solving); }, help)
        ->group(group);
    return;
  }
  const auto read = [&option, solving, name](const std::string& text) {
    try {
      SetOption(option, ParseValue(option.field, text), solving);
    } catch (const InputError& error) {
      throw CLI::ValidationError(name, error.what());
    }
  };
  CLI::Option* added =
      app.add_option_function<std::string>(name, read, help)->type_name(TypeName(option))->group(group);
  if (const std::optional<OptionValue> value = DefaultValue(option))
    added->default_str(ValueText(option.field, *value));
}

}  // namespace

void AddSolveOptions(CLI::App& app, SceneArguments* arguments) {
  // CLI11 reads options in the order in which they were added: --solver, of the first group, before those of
  // a solver.
  for (const OptionGroup group : {OptionGroup::kSolving, OptionGroup::kHierarchical, OptionGroup::kSampled,
                                  OptionGroup::kDense, OptionGroup::kMesh, OptionGroup::kStudies})
    for (const SolveOption& option : OptionTable())
      if (option.group == group) AddSolveOption(app, option, &arguments->solving);
  const auto help = std::make_shared<SolveHelp>();
  help->column_width(app.get_formatter()->get_column_width());
  app.formatter(help);
}

}  // namespace penumbra
