// mesh/pipeline/option_table.h
//
// A table of all options that a user can set for a solve. The command line, the help, the reports, the
// solution files, the window's panel and the checks before a solve is continued all use OptionTable(). A new
// option is a member of PipelineOptions and an entry of the table (option_entries.cpp).

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

// The group's title.
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

// A value of an option of the kind kChoice that serves only to compare methods; the help lists it in the
// group kStudies.
struct StudyChoice {
  std::string name, help;
};

struct SolveOption {
  const char* name = "";  // as in --NAME
  OptionField field = {};
  const char* unit = "";  // of a number; empty: none
  OptionGroup group = OptionGroup::kSolving;
  // The solver that uses it, by its name in LightSolvers(), or the first of several. All use it if this and
  // `form_factors` are empty.
  std::string solver = {};
  std::vector<std::string> other_solvers = {};  // that use it, too
  // Methods in LinkFormFactorMethods() that use it, with every solver that uses the option form-factors.
  std::vector<std::string> form_factors = {};
  bool links_depend =
      false;  // links depend on it: a solve over another solve's links keeps that solve's value
  bool measures_only = false;  // determines only which measurements are made of light and mesh
  bool tiny_distance = false;  // at most a thousandth of the scene's diagonal
  bool flag_clears = false;    // the option is --no-NAME, and sets a flag that is on by default to off
  const char* otherwise = "";  // optional options: a description of the default
  const char* help = "";       // a sentence for --help, without unit, range and default
  std::vector<StudyChoice> study_choices = {};
  // A function that returns the value that the solve uses; only for optional options whose default depends on
  // other options.
  std::function<OptionValue(const ResolvedOptions&)> resolved = {};
  // Returns the value of this option for older solution files, which do not contain the option. `before`
  // holds the file's values of the options that precede this one in the table. The function is empty if all
  // files contain the option.
  std::function<OptionValue(const PipelineOptions& before)> in_older_files = {};
  const char* label = "";    // a few words for the window's panel, without the unit
  const char* setting = "";  // the name in the window, if different from NAME
};

// All options, in the order of reports and solution files.
const std::vector<SolveOption>& OptionTable();
// The option with this name; null if there is no such option.
const SolveOption* FindOption(std::string_view name);

// The option's key in reports and solution files: the name with '_' instead of '-'.
std::string OptionKey(const SolveOption& option);
// The option as the user writes it on the command line: --NAME, or --no-NAME.
std::string CommandLineName(const SolveOption& option);
// The option's name in the window.
std::string SettingName(const SolveOption& option);

// The names of the option's values that the help lists with the option; values that serve only to compare
// methods are excluded.
std::vector<std::string> UsualChoices(const SolveOption& option);
// The option's sentence in the help, including the unit, the range and the description of the default.
std::string OptionHelp(const SolveOption& option);
// The default value; nullopt if the default depends on other options.
std::optional<OptionValue> DefaultValue(const SolveOption& option);

// "the x solver", "the solvers x, y", or "--form-factors a, b": what uses the option. REQUIRES: the option
// is not of all solvers.
std::string OwnersOf(const SolveOption& option);

// True if the chosen solver, or its form factors, use the option.
bool IsObeyed(const SolveOption& option, const PipelineOptions& options);

// The options that a solve uses, with their values, in the order of the table: the contents of reports and
// solution files.
std::vector<std::pair<const SolveOption*, OptionValue>> UsedOptions(const PipelineOptions& options,
                                                                    const ResolvedOptions& resolved);
// Restores the options of a solve from the contents of a file. `told` returns the value of an option in the
// file, or nullopt if the file does not contain the option. If the returned options are resolved and passed
// to UsedOptions(), the result equals the contents of the file. Throws InputError if the file lacks a
// mandatory option, or contains a name that is not among the option's values.
PipelineOptions OptionsToldBy(
    const std::function<std::optional<OptionValue>(const SolveOption& option)>& told);

}  // namespace penumbra
