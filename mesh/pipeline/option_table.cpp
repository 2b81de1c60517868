#include "mesh/pipeline/option_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "mesh/pipeline/option_entries.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

void SetFromFile(const SolveOption& option, const std::optional<OptionValue>& told,
                 PipelineOptions* options) {
  if (told)
    option.field.set(told, options);
  else if (option.in_older_files)
    option.field.set(option.in_older_files(*options), options);
  else if (!option.field.optional || option.resolved)  // files contain every option with a value
    throw InputError(fmt::format("'{}' is missing", OptionKey(option)));
}

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

const std::vector<SolveOption>& OptionTable() {
  static const std::vector<SolveOption> table = OptionEntries();
  return table;
}

const SolveOption* FindOption(std::string_view name) {
  for (const SolveOption& option : OptionTable())
    if (option.name == name) return &option;
  return nullptr;
}

std::string OptionKey(const SolveOption& option) {
  std::string key = option.name;
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

std::string CommandLineName(const SolveOption& option) {
  return fmt::format("--{}{}", option.flag_clears ? "no-" : "", option.name);
}

std::string SettingName(const SolveOption& option) { return *option.setting ? option.setting : option.name; }

std::vector<std::string> UsualChoices(const SolveOption& option) {
  std::vector<std::string> names = option.field.choices();
  std::erase_if(names, [&](const std::string& name) {
    return std::any_of(option.study_choices.begin(), option.study_choices.end(),
                       [&](const StudyChoice& choice) { return choice.name == name; });
  });
  return names;
}

std::string OptionHelp(const SolveOption& option) {
  std::string help = option.help;
  if (*option.unit) help += fmt::format(" [{}]", option.unit);
  if (option.field.kind == OptionKind::kInteger || option.field.kind == OptionKind::kNumber)
    help += "; " + AllowedValues(option.field);
  if (option.tiny_distance) help += ", at most a thousandth of the scene's diagonal";
  if (*option.otherwise) help += fmt::format(" (default: {})", option.otherwise);
  return help;
}

std::optional<OptionValue> DefaultValue(const SolveOption& option) {
  PipelineOptions options;
  return option.field.get(options);
}

std::string OwnersOf(const SolveOption& option) {
  std::string owners;
  if (!option.other_solvers.empty())
    owners = fmt::format("the solvers {}, {}", option.solver, fmt::join(option.other_solvers, ", "));
  else if (!option.solver.empty())
    owners = fmt::format("the {} solver", option.solver);
  if (!option.form_factors.empty())
    owners += fmt::format("{}--form-factors {}", owners.empty() ? "" : " and of ",
                          fmt::join(option.form_factors, ", "));
  return owners;
}

bool IsObeyed(const SolveOption& option, const PipelineOptions& options) {
  if (option.solver.empty() && option.form_factors.empty()) return true;
  if (option.solver == options.SolverName() || Contains(option.other_solvers, options.SolverName()))
    return true;
  return Contains(option.form_factors, options.form_factors) &&
         IsObeyed(*FindOption("form-factors"), options);
}

std::vector<std::pair<const SolveOption*, OptionValue>> UsedOptions(const PipelineOptions& options,
                                                                    const ResolvedOptions& resolved) {
  // The solver may have been chosen for the scene, and a solution file names it.
  PipelineOptions by_solver = options;
  by_solver.solver = resolved.solver_name;
  std::vector<std::pair<const SolveOption*, OptionValue>> used;
  for (const SolveOption& option : OptionTable()) {
    if (!IsObeyed(option, by_solver)) continue;
    const std::optional<OptionValue> value =
        option.resolved ? option.resolved(resolved) : option.field.get(options);
    if (value) used.emplace_back(&option, *value);
  }
  return used;
}

PipelineOptions OptionsToldBy(
    const std::function<std::optional<OptionValue>(const SolveOption& option)>& told) {
  PipelineOptions options;
  // The other options depend on the solver.
  const SolveOption& solver = *FindOption("solver");
  SetFromFile(solver, told(solver), &options);
  for (const SolveOption& option : OptionTable())
    if (&option != &solver && IsObeyed(option, options)) SetFromFile(option, told(option), &options);
  return options;
}

}  // namespace penumbra
