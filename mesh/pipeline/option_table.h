// mesh/pipeline/option_table.h
//
// Everything that a user may set of a solve, in one table. The command line and its help, reports, solution
// files, the window's panel and the checks of a restart are made from it. A new option is a field of
// PipelineOptions and an entry of the table (option_entries.cpp).

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

// Where help lists an option, in the order of help. Those for studies are there to be compared with, and help
// lists them last.
enum class OptionGroup : std::uint8_t { kRunning, kSolving, kHierarchical, kDense, kMesh, kStudies };

// The group's title.
constexpr const char* GroupTitle(OptionGroup group) {
  switch (group) {
    case OptionGroup::kRunning:
      return "Running";
    case OptionGroup::kSolving:
      return "Solving";
    case OptionGroup::kHierarchical:
      return "Hierarchical solver";
    case OptionGroup::kDense:
      return "Dense solver";
    case OptionGroup::kMesh:
      return "Mesh";
    case OptionGroup::kStudies:
      break;
  }
  return "For studies";
}

// A choice that only studies make, which help lists among the options for studies.
struct StudyChoice {
  std::string name, help;
};

struct SolveOption {
  const char* name = "";  // as in --NAME
  OptionField field = {};
  const char* unit = "";  // of a number; empty: it has none
  OptionGroup group = OptionGroup::kSolving;
  std::string solver = {};  // the only solver that obeys it, by LightSolvers(); empty: all solvers do
  bool links_depend =
      false;  // links are made by it: whoever goes on from given links keeps the value of those
  bool measures_only = false;  // it says what is measured of light and mesh, which do not depend on it
  bool tiny_distance = false;  // at most a thousandth of the scene's diagonal
  bool flag_clears = false;    // the flag is --no-NAME, and turns off what is on by default
  const char* otherwise = "";  // of an optional one: what holds where it is left out
  const char* help = "";       // a sentence for --help, without unit, range and default
  std::vector<StudyChoice> study_choices = {};
  // Of an optional one that follows from others: the value that the solve works with.
  std::function<OptionValue(const ResolvedOptions&)> resolved = {};
  // The value that held in the time before solution files told this option, where the options that stand
  // before it in the table are as the file says. Empty: every file tells it.
  std::function<OptionValue(const PipelineOptions& before)> in_older_files = {};
  const char* label = "";    // a few words for the window's panel, without the unit
  const char* setting = "";  // its name in the window, where that is not NAME
};

// In the order of reports and solution files.
const std::vector<SolveOption>& OptionTable();
// Null if there is none of that name.
const SolveOption* FindOption(std::string_view name);

// The name with '_' for '-': the option's key in reports and solution files.
std::string OptionKey(const SolveOption& option);
// As it is given: --NAME, or --no-NAME.
std::string CommandLineName(const SolveOption& option);
// Its name in the window.
std::string SettingName(const SolveOption& option);

// The names of a choice that help lists at the option itself.
std::vector<std::string> UsualChoices(const SolveOption& option);
// The sentence of help with unit, range, and what holds where the option is left out.
std::string OptionHelp(const SolveOption& option);
// The value that holds where the user says nothing; nothing if it follows from others.
std::optional<OptionValue> DefaultValue(const SolveOption& option);

// Whether the chosen solver obeys the option.
bool IsObeyed(const SolveOption& option, const PipelineOptions& options);

// The options that a solve obeys and the values that it works with, in the order of the table: what reports
// and solution files tell.
std::vector<std::pair<const SolveOption*, OptionValue>> UsedOptions(const PipelineOptions& options,
                                                                    const ResolvedOptions& resolved);
// The options of a solve of which a file tells: `told` gives the value, or nothing where the file has none.
// UsedOptions() of these, resolved, are what the file tells. Throws InputError if the file lacks an option
// that every file has, or names a choice that there is not.
PipelineOptions OptionsToldBy(
    const std::function<std::optional<OptionValue>(const SolveOption& option)>& told);

}  // namespace penumbra
