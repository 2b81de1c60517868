// mesh/pipeline/option_table.h
//
// A table of all options that a user can set for a solve. OptionTable() is used by the command line, the
// help, the reports, the solution files, the window's panel and the checks before a solve is continued. To
// add an option, add a member to PipelineOptions and an entry to the table (option_entries.cpp).

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/pipeline/option_field.h"
#include "mesh/pipeline/pipeline.h"

namespace penumbra {

// The groups of options in the help, in the order of the help. The group kStudies contains options that serve
// only to compare methods, and comes last.
enum class OptionGroup : std::uint8_t {
  kRunning,
  kSolving,
  kHierarchical,
  kSampled,
  kDense,
  kMesh,
  kStudies
};

// Returns the title of the group of options in the help.
constexpr const char* GroupTitle(OptionGroup group) {
  switch (group) {
    case OptionGroup::kRunning:
      return "Running";
    case OptionGroup::kSolving:
      return "Solving";
    case OptionGroup::kHierarchical:
      return "Hierarchical solver";
    case OptionGroup::kSampled:
      return "Sampled solver";
    case OptionGroup::kDense:
      return "Dense solver";
    case OptionGroup::kMesh:
      return "Mesh";
    case OptionGroup::kStudies:
      break;
  }
  return "For studies";
}

// A value of an option of the kind kChoice that serves only to compare methods. The help lists each
// StudyChoice in the group kStudies.
struct StudyChoice {
  std::string name, help;
};

struct SolveOption {
  const char* name = "";  // name of the option, as in --NAME
  OptionField field = {};
  const char* unit = "";  // the unit of an option whose value is a number; empty if it has no unit
  OptionGroup group = OptionGroup::kSolving;
  // The name, in LightSolvers(), of the first solver that uses the option. All solvers use the option if
  // `solver` and `form_factors` are empty.
  std::string solver = {};
  std::vector<std::string> other_solvers = {};  // the names of further solvers that use the option
  // Names of form-factor methods in LinkFormFactorMethods() that use the option, with every solver that has
  // the option form-factors.
  std::vector<std::string> form_factors = {};
  // True if the links between elements depend on the option. If links depend on an option, a solve that
  // reuses the links of another solve keeps the other solve's value of the option.
  bool links_depend = false;
  bool measures_only = false;  // true if the option affects only measurements, not light and mesh
  bool tiny_distance = false;  // true if the option's distance is at most scene diagonal / 1000
  // True if the option is --no-NAME, and sets a flag that is on by default to off.
  bool flag_clears = false;
  const char* otherwise = "";  // words that describe the default of an option without a fixed default value
  // The sentence that --help prints about the option, without unit, range and default.
  const char* help = "";
  std::vector<StudyChoice> study_choices = {};
  // A function that returns the value of the option that the solve uses. The function `resolved` is empty
  // unless the option is optional and its default depends on other options.
  std::function<OptionValue(const ResolvedOptions&)> resolved = {};
  // A function that returns the value of the option for older solution files, which do not contain the
  // option. `before` holds the values, from the solution file, of the options that precede this option in
  // OptionTable(). The function in_older_files is empty if all solution files contain the option.
  std::function<OptionValue(const PipelineOptions& before)> in_older_files = {};
  const char* label = "";    // label of the option in the window's panel, in a few words, without the unit
  const char* setting = "";  // the name of the option in the window, if it differs from `name`
};

// Returns all options of a solve, in the order of reports and solution files.
const std::vector<SolveOption>& OptionTable();
// Returns the option with the name `name`, or null if no option has this name.
const SolveOption* FindOption(std::string_view name);

// Returns the option's key in reports and solution files: the name with '_' instead of '-'.
std::string OptionKey(const SolveOption& option);
// Returns the option as the user writes it on the command line: --NAME, or --no-NAME.
std::string CommandLineName(const SolveOption& option);
// Returns the option's name in the window.
std::string SettingName(const SolveOption& option);

// Returns the names of the option's values that the help lists with the option. UsualChoices() excludes
// values that serve only to compare methods.
std::vector<std::string> UsualChoices(const SolveOption& option);
// Returns the option's sentence in the help, including the unit, the range and the description of the
// default.
std::string OptionHelp(const SolveOption& option);
// Returns the option's default value, or nullopt if the default depends on other options.
std::optional<OptionValue> DefaultValue(const SolveOption& option);

// Returns a text that names the solvers or the form-factor methods that use the option: "the x solver", "the
// solvers x, y", or "--form-factors a, b". REQUIRES: the option does not belong to all solvers.
std::string OwnersOf(const SolveOption& option);

// True if the chosen solver, or its method for form factors, uses the option.
bool IsObeyed(const SolveOption& option, const PipelineOptions& options);

// Returns the options that a solve uses, with their values, in the order of the table. Reports and solution
// files contain the options that UsedOptions() returns.
std::vector<std::pair<const SolveOption*, OptionValue>> UsedOptions(const PipelineOptions& options,
                                                                    const ResolvedOptions& resolved);
// Restores the options of a solve from a report or a solution file. `told` returns the value of an option in
// the file, or nullopt if the file does not contain the option. If the returned options are passed to
// Resolve() and UsedOptions(), the result equals the options in the file. Throws InputError if the file lacks
// a mandatory option, or contains a name that is not among the option's values.
PipelineOptions OptionsToldBy(
    const std::function<std::optional<OptionValue>(const SolveOption& option)>& told);

}  // namespace penumbra
