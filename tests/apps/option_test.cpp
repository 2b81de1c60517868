// The table of options as users meet it: on the command line, in help, in reports and solution files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mesh/pipeline/option_table.h"
#include "tests/apps/run_program.h"

namespace penumbra {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

// Values other than the default that suit each other, for each option but those of the other solvers; of a
// flag nothing.
const std::map<std::string, std::string>& Given() {
  static const std::map<std::string, std::string> given = {{"seed", "7"},
                                                           {"error", "0.5"},
                                                           {"as-thesis", ""},
                                                           {"eps", "3"},
                                                           {"min-area", "0.02"},
                                                           {"discontinuities", "adaptive"},
                                                           {"weight", "thesis"},
                                                           {"min-discontinuity-weight", "2"},
                                                           {"min-wanted-weight", "1"},
                                                           {"corner-divisions", "1"},
                                                           {"max-leaf-dsets", "3"},
                                                           {"keep-hidden-discontinuities", ""},
                                                           {"eee", "0.1"},
                                                           {"error-samples", "2"},
                                                           {"refine", "representation"},
                                                           {"corrections", "1"},
                                                           {"source-error", "0.25"},
                                                           {"acceleration", ""},
                                                           {"scheme", "gauss-seidel"},
                                                           {"oracle", "gradient"},
                                                           {"multigrid", ""},
                                                           {"relative-cutoff", "0.001"},
                                                           {"iterations", "50"},
                                                           {"time-limit", "1000"},
                                                           {"memory-limit", "1e+12"},
                                                           {"bounces", "2"},
                                                           {"nudge", "1e-06"},
                                                           {"source-push-off", "1e-06"},
                                                           {"min-backprojection-segment", "0.001"},
                                                           {"method", "backprojection"},
                                                           {"form-factors", "exact"},
                                                           {"solver", "hierarchical"},
                                                           {"error-points", "20"},
                                                           {"crowded-splits", "1"}};
  return given;
}
const std::map<std::string, std::string>& GivenToDense() {
  static const std::map<std::string, std::string> given = {{"solver", "dense"}, {"basis", "linear"},
                                                           {"divisions", "2"},  {"error-points", "20"},
                                                           {"by-emitter", ""},  {"emitters", "object"}};
  return given;
}

const std::map<std::string, std::string>& GivenToSampled() {
  static const std::map<std::string, std::string> given = {
      {"solver", "sampled"}, {"rays", "64"}, {"error", "0.5"}, {"error-points", "20"}};
  return given;
}

const std::map<std::string, std::string>& GivenToProgressive() {
  static const std::map<std::string, std::string> given = {{"solver", "progressive"},
                                                           {"form-factors", "hemicube"},
                                                           {"resolution", "20"},
                                                           {"divisions", "2"},
                                                           {"shots", "9"},
                                                           {"overshoot", ""},
                                                           {"ambient", ""},
                                                           {"error-points", "20"}};
  return given;
}

// Solves with these options, and expects each in the report, in the file, and in the report of the file.
void ExpectRoundTrip(const std::map<std::string, std::string>& given) {
  const Sandbox sandbox;
  std::vector<std::string> command = {"solve", "furnace", "-o", "a.h5", "--report", "solve.json"};
  for (const auto& [name, text] : given) {
    command.push_back(CommandLineName(*FindOption(name)));
    if (!text.empty()) command.push_back(text);
  }
  const Outcome solve = sandbox.Run(command);
  ASSERT_EQ(solve.status, 0) << solve.err;
  const Outcome info = sandbox.Run({"info", "a.h5", "--report", "info.json"});
  ASSERT_EQ(info.status, 0) << info.err;
  Json solved = Json::parse(ReadBytes(sandbox.Path("solve.json")))["options"];
  for (const auto& [name, text] : given) {
    const SolveOption& option = *FindOption(name);
    const Json& value = solved[OptionKey(option)];
    if (option.field.kind == OptionKind::kFlag)
      EXPECT_EQ(value, !option.flag_clears) << name;
    else if (option.field.kind == OptionKind::kChoice)
      EXPECT_EQ(value, text) << name;
    else
      EXPECT_EQ(value.get<double>(), std::stod(text)) << name;
  }
  Json kept = Json::parse(ReadBytes(sandbox.Path("info.json")))["options"];
  solved.erase("threads");
  kept.erase("threads");
  kept.erase("solution");
  EXPECT_EQ(kept.dump(), solved.dump());
}

// Whatever is given is in the report, and in the file, from which it comes back.
TEST(Options, EveryOneIsReportedAndKept) {
  for (const SolveOption& option : OptionTable())
    EXPECT_TRUE(Given().contains(option.name) || GivenToDense().contains(option.name) ||
                GivenToSampled().contains(option.name) || GivenToProgressive().contains(option.name))
        << option.name;
  ExpectRoundTrip(Given());
  ExpectRoundTrip(GivenToDense());
  ExpectRoundTrip(GivenToSampled());
  ExpectRoundTrip(GivenToProgressive());
}

// The lines of help about an option, with what stands behind its name.
std::string HelpOf(const std::string& help, const SolveOption& option) {
  const std::string name = "\n  " + CommandLineName(option) + " ";
  const std::size_t begin = help.find(name);
  if (begin == std::string::npos) return "";
  std::size_t end = help.find('\n', begin + 1);
  if (help.compare(end, 10, "\n         ") == 0)
    end = help.find('\n', end + 1);  // a long name has its own line
  std::string lines = help.substr(begin + 1, end - begin);
  std::replace(lines.begin(), lines.end(), '\n', ' ');
  return lines;
}

// Help tells the default that PipelineOptions has, and unit and range in the same words everywhere.
TEST(Options, HelpTellsDefaultsUnitsAndRanges) {
  const std::string help = Sandbox().Run({"solve", "--help"}).out;
  for (const SolveOption& option : OptionTable()) {
    SCOPED_TRACE(option.name);
    const std::string lines = HelpOf(help, option);
    ASSERT_NE(lines, "");
    const std::optional<OptionValue> value = DefaultValue(option);
    if (option.field.kind == OptionKind::kFlag) {
      EXPECT_EQ(std::get<bool>(*value), option.flag_clears);
    } else if (value) {
      EXPECT_THAT(lines, HasSubstr("=" + ValueText(option.field, *value) + " "));
    } else {
      EXPECT_THAT(lines, HasSubstr(std::string("(default: ") + option.otherwise + ")"));
    }
    if (option.group != OptionGroup::kRunning) {
      EXPECT_THAT(lines, HasSubstr(OptionHelp(option)));
    }
  }
}

// What only studies compare stands in the last group, choices among it, and nothing of it before.
TEST(Options, HelpListsStudiesLast) {
  for (const char* command : {"solve", "render", "probe", "export", "view", "info"}) {
    const std::string help = Sandbox().Run({command, "--help"}).out;
    const std::size_t at = help.find("\nFor studies:\n");
    ASSERT_NE(at, std::string::npos) << command;
    const std::string before = help.substr(0, at), studies = help.substr(at);
    for (const char* group :
         {"Scene:", "Running:", "Solving:", "Hierarchical solver:", "Dense solver:", "Mesh:"})
      EXPECT_THAT(before, HasSubstr(std::string("\n") + group + "\n")) << command;
    for (const char* name :
         {"--keep-hidden-discontinuities", "--corner-divisions", "--no-acceleration", "--scheme", "--nudge",
          "--source-push-off", "--min-backprojection-segment", "--discontinuities random",
          "--discontinuities all", "--weight thesis", "--oracle thesis", "--form-factors disk"}) {
      EXPECT_THAT(studies, HasSubstr(std::string("\n  ") + name + " ")) << command;
      EXPECT_THAT(before, testing::Not(HasSubstr(std::string("\n  ") + name + " "))) << command;
    }
  }
  const std::string render = Sandbox().Run({"render", "--help"}).out;
  EXPECT_GT(render.find("--opengl-coordinates"), render.find("\nFor studies:\n"));
}

// --as-thesis sets what the thesis had; options beside it win, wherever they stand; the report tells both.
TEST(Options, AsThesisGivesWayToOthers) {
  const Sandbox sandbox;
  const Outcome outcome = sandbox.Run({"solve", "floating-cube", "--eps", "0.5", "--as-thesis", "--oracle",
                                       "transport", "--error-points", "0", "--report", "r.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json options = Json::parse(ReadBytes(sandbox.Path("r.json")))["options"];
  EXPECT_EQ(options["as_thesis"], true);
  EXPECT_EQ(options["eps"], 0.5);
  EXPECT_EQ(options["oracle"], "transport");
  EXPECT_EQ(options["min_area"], 0.015);
  EXPECT_EQ(options["weight"], "thesis");
  EXPECT_EQ(options["acceleration"], false);
  EXPECT_EQ(options["corrections"], 0);
  EXPECT_EQ(options["crowded_splits"], 0);
  const Outcome dense = sandbox.Run({"solve", "furnace", "--as-thesis", "--solver", "dense"});
  EXPECT_EQ(dense.status, 2);
  EXPECT_THAT(dense.err, HasSubstr("--as-thesis is of the hierarchical solver"));
}

// What is out of range is refused in one line that names the option and says what may be.
TEST(Options, RefusalsSayWhatMayBe) {
  const Sandbox sandbox;
  for (const auto& [arguments, message] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--error", "0"}, "--error: '0' is not a number from 1e-6 to 10"},
           {{"--eee", "1e-10"}, "--eee: '1e-10' is not 0, or a number from 1e-9 to 1e9"},
           {{"--iterations", "0"}, "--iterations: '0' is not an integer from 1 to 1000000"},
           {{"--weight", "x"}, "--weight: 'x' is not one of thesis|irradiance"},
           {{"--basis", "linear"},
            "--basis: it is of the dense solver; give --solver dense, or leave it out"}}) {
    std::vector<std::string> command = {"solve", "furnace"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    EXPECT_EQ(sandbox.Run(command).err, "penumbra: error: " + message + "; see `penumbra --help`\n");
  }
  EXPECT_EQ(sandbox.Run({"solve", "furnace", "--solver", "dense", "--no-acceleration"}).err,
            "penumbra: error: --no-acceleration is of the hierarchical solver and means nothing to --solver "
            "dense; leave one of them out\n");
}

}  // namespace
}  // namespace penumbra
