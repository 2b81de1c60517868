// The table of options: whatever an entry says holds for the field, and what users knew before there was a
// table is as it was.

#include "mesh/pipeline/option_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mesh/pipeline/link_options.h"
#include "mesh/pipeline/thesis_options.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "solver/transport/links/refinement_oracles.h"
#include "solver/transport/solvers/light_solvers.h"
#include "tests/mesh/mesh_test_scenes.h"

namespace penumbra {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

Scene LitRoom() {
  Scene scene = mesh_test::EmptyScene();
  mesh_test::AddSquare(scene, {0, 0, 0}, 1, true);
  mesh_test::AddSquare(scene, {0, 0, 2}, 0.5, false, 1);
  return scene;
}

// Options that choose the solver of an entry.
PipelineOptions OptionsFor(const SolveOption& option) {
  PipelineOptions options;
  if (!option.solver.empty())
    options.solver = option.solver;
  else if (!option.form_factors.empty())
    options.form_factors = option.form_factors.front();
  return options;
}

// Both ends of what the option may be, something between, and all choices.
std::vector<OptionValue> Samples(const OptionField& field) {
  std::vector<OptionValue> samples;
  switch (field.kind) {
    case OptionKind::kFlag:
      return {true, false};
    case OptionKind::kInteger:
      return {field.integers.low, field.integers.high};
    case OptionKind::kNumber:
      samples = {field.numbers.low, field.numbers.high, (field.numbers.low + field.numbers.high) / 3};
      if (field.numbers.or_zero) samples.emplace_back(0.0);
      return samples;
    case OptionKind::kChoice:
      for (const std::string& name : field.choices()) samples.emplace_back(name);
  }
  return samples;
}

using Told = std::map<std::string, OptionValue>;

Told ToldOf(const PipelineOptions& options, const Scene& scene) {
  Told told;
  for (const auto& [option, value] : UsedOptions(options, Resolve(scene, options)))
    told[OptionKey(*option)] = value;
  return told;
}

Told ToldOf(const PipelineOptions& options) {
  static const Scene scene = LitRoom();
  return ToldOf(options, scene);
}

PipelineOptions ReadBack(const Told& told) {
  return OptionsToldBy([&](const SolveOption& option) -> std::optional<OptionValue> {
    const auto found = told.find(OptionKey(option));
    if (found == told.end()) return std::nullopt;
    return found->second;
  });
}

// The whole text of the message of an error; empty if nothing was thrown.
template <class Action>
std::string ErrorOf(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// What is set is there, is told, and comes back out of a file and out of its own text; with it comes all
// else.
TEST(OptionTable, EveryEntryRoundTrips) {
  for (const SolveOption& option : OptionTable())
    for (const OptionValue& value : Samples(option.field)) {
      SCOPED_TRACE(option.name + (" " + ValueText(option.field, value)));
      PipelineOptions options = OptionsFor(option);
      option.field.set(value, &options);
      EXPECT_EQ(option.field.get(options), value);
      EXPECT_EQ(ParseValue(option.field, ValueText(option.field, value)), value);
      const Told told = ToldOf(options);
      ASSERT_TRUE(told.contains(OptionKey(option)));
      EXPECT_EQ(told.at(OptionKey(option)), value);
      const PipelineOptions back = ReadBack(told);
      EXPECT_EQ(option.field.get(back), value);
      EXPECT_EQ(ToldOf(back), told);
    }
}

// An option that may be left out is left out by nothing. Then the value is told that it came to, if there is
// one.
TEST(OptionTable, OptionalEntriesAreLeftOut) {
  std::vector<std::string> left_out;
  for (const SolveOption& option : OptionTable()) {
    EXPECT_EQ(option.field.optional, *option.otherwise != '\0') << option.name;
    EXPECT_EQ(DefaultValue(option).has_value(), !option.field.optional) << option.name;
    if (!option.field.optional) continue;
    SCOPED_TRACE(option.name);
    left_out.emplace_back(option.name);
    PipelineOptions options = OptionsFor(option);
    option.field.set(Samples(option.field).front(), &options);
    option.field.set(std::nullopt, &options);
    EXPECT_FALSE(option.field.get(options));
    EXPECT_EQ(ToldOf(options).contains(OptionKey(option)), static_cast<bool>(option.resolved));
    EXPECT_EQ(ToldOf(ReadBack(ToldOf(options))), ToldOf(options));
  }
  EXPECT_THAT(left_out, UnorderedElementsAre("eps", "min-area", "weight", "min-discontinuity-weight",
                                             "min-wanted-weight", "source-error", "relative-cutoff",
                                             "time-limit", "memory-limit", "solver"));
}

// Where the solver was chosen for the scene, a file tells the options of this solver, not those of the
// default.
TEST(OptionTable, OptionsOfASolverThatWasChosenComeBack) {
  const Scene scene = *LoadBuiltinScene("building-2x2", {});
  PipelineOptions options;
  options.error = 0.1;
  ASSERT_EQ(SolverFor(scene, options), "sampled");
  const Told told = ToldOf(options, scene);
  EXPECT_TRUE(told.contains("rays"));
  EXPECT_FALSE(told.contains("eps"));
  EXPECT_EQ(ToldOf(ReadBack(told), scene), told);
}

// The keys of reports and solution files, in order: other programs read them.
TEST(OptionTable, KeysAndTheirOrderStay) {
  std::vector<std::string> keys;
  for (const SolveOption& option : OptionTable()) keys.push_back(OptionKey(option));
  EXPECT_THAT(
      keys, ElementsAre("seed", "error", "as_thesis", "eps", "min_area", "discontinuities", "weight",
                        "min_discontinuity_weight", "min_wanted_weight", "corner_divisions", "max_leaf_dsets",
                        "keep_hidden_discontinuities", "eee", "error_samples", "refine", "corrections",
                        "source_error", "acceleration", "scheme", "oracle", "multigrid", "relative_cutoff",
                        "iterations", "time_limit", "memory_limit", "bounces", "nudge", "source_push_off",
                        "min_backprojection_segment", "method", "form_factors", "solver", "rays",
                        "resolution", "basis", "divisions", "shots", "overshoot", "ambient", "error_points",
                        "by_emitter", "emitters", "crowded_splits"));
}

std::vector<std::string> NamesWhere(bool (*holds)(const SolveOption&)) {
  std::vector<std::string> names;
  for (const SolveOption& option : OptionTable())
    if (holds(option)) names.emplace_back(option.name);
  return names;
}

// The options that a restart keeps, and those of one solver alone.
TEST(OptionTable, LinkOptionsAndSolversStay) {
  EXPECT_THAT(NamesWhere([](const SolveOption& option) { return IsLinkOption(option.name); }),
              UnorderedElementsAre("eps", "iterations", "oracle", "multigrid", "form-factors", "solver",
                                   "resolution", "basis", "divisions"));
  EXPECT_FALSE(IsLinkOption("mode"));
  EXPECT_THAT(NamesWhere([](const SolveOption& option) { return option.solver == "hierarchical"; }),
              UnorderedElementsAre("as-thesis", "eps", "refine", "relative-cutoff", "corrections",
                                   "source-error", "acceleration", "scheme", "oracle", "multigrid",
                                   "iterations", "bounces", "form-factors"));
  EXPECT_THAT(NamesWhere([](const SolveOption& option) { return option.solver == "dense"; }),
              UnorderedElementsAre("basis", "divisions"));
  EXPECT_THAT(NamesWhere([](const SolveOption& option) { return option.solver == "sampled"; }),
              UnorderedElementsAre("rays"));
}

// Options that say how links are made go over, the solver among them, and no other.
TEST(OptionTable, LinkOptionsAreTaken) {
  PipelineOptions from, to;
  from.eps = 3;
  from.max_iterations = 7;
  from.oracle = "gradient";
  from.multigrid = true;
  from.form_factors = "exact";
  from.error = 0.5;
  to.min_area = 1;
  TakeLinkOptions(from, &to);
  EXPECT_EQ(to.eps, 3);
  EXPECT_EQ(to.max_iterations, 7);
  EXPECT_EQ(to.oracle, "gradient");
  EXPECT_TRUE(to.multigrid);
  EXPECT_EQ(to.form_factors, "exact");
  EXPECT_EQ(to.error, PipelineOptions().error);
  EXPECT_EQ(to.min_area, 1);
  PipelineOptions dense = OptionsFor(*FindOption("basis"));
  FindOption("basis")->field.set(OptionValue("quadratic"), &dense);
  FindOption("divisions")->field.set(OptionValue(std::uint64_t{16}), &dense);
  TakeLinkOptions(dense, &to);
  EXPECT_EQ(ToldOf(to)["basis"], OptionValue("quadratic"));
  EXPECT_EQ(ToldOf(to)["divisions"], OptionValue(std::uint64_t{16}));
  EXPECT_FALSE(to.eps);
  TakeLinkOptions(from, &to);
  EXPECT_EQ(to.SolverName(), "hierarchical");
}

std::string OneOf(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "one of " : "|") + name;
  return all;
}

// What each option may be, in the words that users know.
std::map<std::string, std::string> WordsOfRanges() {
  const std::string from_zero = "a number from 0 to 1e100", relative = "a number from 1e-6 to 10";
  return {{"seed", "an integer from 0 to 18446744073709551615"},
          {"error", relative},
          {"as-thesis", "one of off|on"},
          {"eps", "a number from 1e-100 to 1e100"},
          {"min-area", from_zero},
          {"discontinuities", "one of ranked|adaptive|none|random|all"},
          {"weight", "one of thesis|irradiance"},
          {"min-discontinuity-weight", from_zero},
          {"min-wanted-weight", from_zero},
          {"corner-divisions", "an integer from 0 to 20"},
          {"max-leaf-dsets", "an integer from 0 to 1000000"},
          {"keep-hidden-discontinuities", "one of off|on"},
          {"eee", "0, or a number from 1e-9 to 1e9"},
          {"error-samples", "an integer from 1 to 100"},
          {"refine", "one of transport|representation|both"},
          {"corrections", "an integer from 0 to 100"},
          {"source-error", relative},
          {"acceleration", "one of none|anderson"},
          {"scheme", "one of jacobi|gauss-seidel"},
          {"oracle", OneOf(RefinementOracles().Names())},
          {"multigrid", "one of off|on"},
          {"relative-cutoff", "a number from 1e-15 to 1"},
          {"iterations", "an integer from 1 to 1000000"},
          {"time-limit", "a number from 1e-9 to 1e9"},
          {"memory-limit", "a number from 1 to 1e18"},
          {"bounces", "an integer from 0 to 1000"},
          {"nudge", from_zero},
          {"source-push-off", from_zero},
          {"min-backprojection-segment", "a number from 0 to 1"},
          {"method", "one of auto|clipping|backprojection|vertex-tracing|sampled"},
          {"form-factors", OneOf(LinkFormFactorMethods().Names())},
          {"solver", OneOf(LightSolvers().Names())},
          {"rays", "an integer from 0 to 10000000"},
          {"resolution", "an integer from 0 to 4096"},
          {"basis", "one of constant|linear|quadratic"},
          {"divisions", "a power of two from 1 to 64"},
          {"shots", "an integer from 0 to 1000000"},
          {"overshoot", "one of off|on"},
          {"ambient", "one of off|on"},
          {"error-points", "an integer from 0 to 100000000"},
          {"by-emitter", "one of off|on"},
          {"emitters", "one of face|object|material"},
          {"crowded-splits", "an integer from 0 to 20"}};
}

// What is out of range is refused in these words.
TEST(OptionTable, RangesStay) {
  const std::map<std::string, std::string> words = WordsOfRanges();
  EXPECT_EQ(words.size(), OptionTable().size());
  for (const SolveOption& option : OptionTable()) {
    SCOPED_TRACE(option.name);
    ASSERT_TRUE(words.contains(option.name));
    EXPECT_EQ(AllowedValues(option.field), words.at(option.name));
    std::vector<std::string> bad = {"", "nan", "inf", "1x", " 1", "-1", "1e300", "?"};
    const NumberRange& numbers = option.field.numbers;
    const double infinity = std::numeric_limits<double>::infinity();
    if (option.field.kind == OptionKind::kNumber)
      for (const double out :
           {std::nextafter(numbers.low, -infinity), std::nextafter(numbers.high, infinity)})
        bad.push_back(ValueText(option.field, out));
    if (option.field.kind == OptionKind::kInteger) {
      bad.insert(bad.end(), {"1.5", "1e1", "18446744073709551616"});
      if (option.field.integers.high < std::numeric_limits<std::uint64_t>::max())
        bad.push_back(std::to_string(option.field.integers.high + 1));
    }
    if (option.field.integers.powers_of_two) bad.emplace_back("3");
    for (const std::string& text : bad)
      EXPECT_EQ(ErrorOf([&] { ParseValue(option.field, text); }),
                "'" + text + "' is not " + words.at(option.name));
  }
}

// Files from before there was an option mean what held then; what every file tells must be there.
TEST(OptionTable, OlderFilesMeanWhatHeldThen) {
  const std::map<std::string, OptionValue> later = {{"discontinuities", "ranked"},
                                                    {"weight", "thesis"},
                                                    {"min_wanted_weight", 0.25},
                                                    {"corner_divisions", std::uint64_t{0}},
                                                    {"keep_hidden_discontinuities", false},
                                                    {"eee", 0.0},
                                                    {"min_backprojection_segment", 0.0},
                                                    {"method", "auto"},
                                                    {"by_emitter", false},
                                                    {"emitters", "face"},
                                                    {"as_thesis", false},
                                                    {"crowded_splits", std::uint64_t{3}}};
  const std::set<std::string> never_needed = {"source_error", "time_limit", "memory_limit"};
  PipelineOptions options;
  options.min_discontinuity_weight = 0.25;
  options.weight = DiscontinuityWeight::kIrradiance;
  for (const PipelineOptions& solved : {options, OptionsFor(*FindOption("basis"))}) {
    const Told all = ToldOf(solved);
    for (const auto& [key, value] : all) {
      SCOPED_TRACE(key);
      Told without = all;
      without.erase(key);
      const bool needed = !later.contains(key) && !never_needed.contains(key);
      EXPECT_EQ(ErrorOf([&] { ReadBack(without); }), needed ? "'" + key + "' is missing" : "");
    }
  }
  Told old = ToldOf(options);
  for (const auto& [key, value] : later) old.erase(key);
  const Told read = ToldOf(ReadBack(old));
  for (const auto& [key, value] : later) EXPECT_EQ(read.at(key), value) << key;
}

// as-thesis sets what the thesis had; what is set afterwards wins, also when the options are read back; and
// what still is the thesis's is reset when as-thesis is.
TEST(OptionTable, AsThesisSetsTheThesissOptions) {
  const OptionField& as_thesis = FindOption("as-thesis")->field;
  PipelineOptions options;
  options.max_corrections = 7;
  as_thesis.set(OptionValue(true), &options);
  EXPECT_TRUE(options.as_thesis);
  for (const ThesisSetting& setting : AllThesisSettings()) {
    const SolveOption* option = FindOption(setting.option);
    ASSERT_NE(option, nullptr) << setting.option;
    EXPECT_EQ(option->field.get(options), ParseValue(option->field, setting.value)) << setting.option;
  }
  EXPECT_EQ(options.max_corrections, 0);
  EXPECT_EQ(options.eps, 0.1);
  options.eps = 0.2;
  const PipelineOptions back = ReadBack(ToldOf(options));
  EXPECT_TRUE(back.as_thesis);
  EXPECT_EQ(back.eps, 0.2) << "an option beside as-thesis wins";
  EXPECT_EQ(back.oracle, "thesis");
  as_thesis.set(OptionValue(true), &options);
  EXPECT_EQ(options.eps, 0.2) << "to set it twice changes nothing";
  as_thesis.set(OptionValue(false), &options);
  EXPECT_EQ(options.eps, 0.2);
  options.eps.reset();
  EXPECT_EQ(ToldOf(options), ToldOf(PipelineOptions()));
}

// A name that is no choice, in a damaged file, is refused.
TEST(OptionTable, UnknownChoicesAreRefused) {
  for (const SolveOption& option : OptionTable()) {
    if (option.field.kind != OptionKind::kChoice) continue;
    Told told = ToldOf(OptionsFor(option));
    told[OptionKey(option)] = "nonsense";
    EXPECT_THAT(ErrorOf([&] { ReadBack(told); }), testing::HasSubstr("nonsense")) << option.name;
  }
}

// Entries are whole, and no name stands for two.
TEST(OptionTable, EntriesAreWhole) {
  std::set<std::string> names, settings, given;
  for (const SolveOption& option : OptionTable()) {
    SCOPED_TRACE(option.name);
    EXPECT_TRUE(names.insert(option.name).second);
    EXPECT_TRUE(settings.insert(SettingName(option)).second);
    EXPECT_TRUE(given.insert(CommandLineName(option)).second);
    EXPECT_EQ(FindOption(option.name), &option);
    EXPECT_STRNE(option.help, "");
    EXPECT_STRNE(option.label, "");
    EXPECT_NE(std::string(option.help).back(), '.');
    if (!option.solver.empty()) {
      EXPECT_THAT(FindOption("solver")->field.choices(), testing::Contains(option.solver));
    }
    if (*option.unit) {
      EXPECT_EQ(option.field.kind, OptionKind::kNumber);
      EXPECT_THAT(OptionHelp(option),
                  HasSubstr(std::string(" [") + option.unit + "]; " + AllowedValues(option.field)));
    }
    for (const StudyChoice& choice : option.study_choices) {
      EXPECT_THAT(option.field.choices(), testing::Contains(choice.name));
      EXPECT_THAT(UsualChoices(option), testing::Not(testing::Contains(choice.name)));
    }
  }
  EXPECT_EQ(CommandLineName(*FindOption("acceleration")), "--no-acceleration");
  EXPECT_EQ(FindOption("no-such-option"), nullptr);
}

}  // namespace
}  // namespace penumbra
