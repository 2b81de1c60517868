// `solve --by-emitter` and `--dim`: the light of lamps, scaled without a solve.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/apps/run_program.h"

namespace penumbra {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr const char* kDimPoints =
    "x,y,z,nx,ny,nz\n0.3,-0.9,0,0,0,1\n0.1,-0.5,0.2,0.3,0.2,1\n-0.7,0.4,0,0,0,1\n0.4,0.2,0,0,0,1\n";

// The six values of each point.
std::vector<double> DimProbe(const Sandbox& sandbox, const std::vector<std::string>& input) {
  const Outcome outcome = sandbox.Run(With({"probe", "--points", "points.csv"}, input));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::vector<double> values;
  const std::vector<std::string> lines = Lines(outcome.out);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = Fields(lines[i]);
    for (std::size_t k = 7; k < fields.size(); ++k) values.push_back(std::stod(fields[k]));
  }
  return values;
}

class Dim : public testing::Test {
 protected:
  Dim() { sandbox_.Write("points.csv", kDimPoints); }

  void Solve(const std::vector<std::string>& more) {
    const Outcome outcome = sandbox_.Run(
        With({"solve", "floating-cube", "--error", "0.3", "--error-points", "50", "-o", "a.h5"}, more));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

  Sandbox sandbox_;
};

// Light adds up: the left lamp alone and the right lamp alone give both together, and a factor scales.
TEST_F(Dim, LampsAddUp) {
  Solve({"--by-emitter"});
  const std::vector<double> both = DimProbe(sandbox_, {"a.h5"}),
                            left = DimProbe(sandbox_, {"a.h5", "--dim", "right_light=0"}),
                            right = DimProbe(sandbox_, {"a.h5", "--dim", "object:left_light=0"}),
                            mixed = DimProbe(sandbox_, {"a.h5", "--dim", "left_light=0.25", "--dim",
                                                        "material:right_light=2,0,1"});
  double worst = 0;
  const double weight[3] = {2, 0, 1};
  for (std::size_t i = 0; i < both.size(); ++i) {
    if (std::isnan(both[i])) continue;
    worst = std::max({worst, std::abs(left[i] + right[i] - both[i]) / both[i],
                      std::abs(0.25 * left[i] + weight[i % 3] * right[i] - mixed[i]) / both[i]});
  }
  std::printf("lamps add up within %.2g\n", worst);
  EXPECT_LE(worst, 1e-11);
}

// Every command takes it. Factor 1 gives the bytes of the light as it was solved, and factor 0 of all lamps
// the dark.
TEST_F(Dim, OneChangesNoByte) {
  Solve({"--by-emitter"});
  for (const auto& [command, output] :
       {std::pair(std::vector<std::string>{"render", "--size", "16x12"}, "a.exr"),
        {{"probe", "--points", "points.csv"}, "a.csv"},
        {{"export"}, "a.vtu"}}) {
    const std::string other = std::string("one-") + output;
    ASSERT_EQ(sandbox_.Run(With(command, {"a.h5", "-o", output})).status, 0);
    const Outcome one =
        sandbox_.Run(With(command, {"a.h5", "-o", other, "--dim", "left_light=1", "--dim", "1=1"}));
    // Face 1 is of the cube, which emits nothing.
    EXPECT_EQ(one.status, 2);
    ASSERT_EQ(sandbox_.Run(With(command, {"a.h5", "-o", other, "--dim", "left_light=1"})).status, 0);
    EXPECT_EQ(ReadBytes(sandbox_.Path(output)), ReadBytes(sandbox_.Path(other))) << output;
  }
  for (const double value : DimProbe(sandbox_, {"a.h5", "--dim", "left_light=0", "--dim", "right_light=0"}))
    EXPECT_TRUE(std::isnan(value) || value == 0) << value;
}

// A scene that is dimmed is solved with the other emittance.
TEST_F(Dim, OfASceneIsAnotherEmittance) {
  const std::vector<std::string> how = {"floating-cube", "--error", "0.5", "--error-points", "10"};
  const auto probe = [&](const std::vector<std::string>& more) {
    return sandbox_.Run(With(With({"probe", "--points", "points.csv"}, how), more)).out;
  };
  EXPECT_EQ(probe({"--dim", "left_light=0.5"}), probe({"--emittance", "left_light=150,135,105"}));
}

// What cannot be dimmed is told in one line, with the names that are most like the given one.
TEST_F(Dim, RefusesWhatIsNoEmitter) {
  Solve({});
  ASSERT_EQ(sandbox_
                .Run({"solve", "floating-cube", "--error", "0.5", "--error-points", "10", "--by-emitter",
                      "--emitters", "object", "-o", "b.h5"})
                .status,
            0);
  struct Case {
    std::vector<std::string> arguments;
    int status;
    std::string says;
  };
  for (const Case& c :
       {Case{{"b.h5", "--dim", "left_lihgt=0"}, 2, "did you mean 'left_light'"},
        Case{{"floating-cube", "--dim", "left_lihgt=0"}, 2, "did you mean 'left_light'"},
        Case{{"b.h5", "--dim", "cube=0"}, 2, "'cube' emits nothing"},
        Case{{"b.h5", "--dim", "left_light=-1"}, 2, "is not NAME=FACTOR"},
        Case{{"b.h5", "--dim", "left_light"}, 2, "is not NAME=FACTOR"},
        Case{{"a.h5", "--dim", "left_light=0"}, 1, "it does not keep the light of each emitter"}}) {
    const Outcome outcome = sandbox_.Run(With({"probe", "--points", "points.csv"}, c.arguments));
    EXPECT_EQ(outcome.status, c.status) << c.says;
    EXPECT_THAT(outcome.err, HasSubstr(c.says));
    EXPECT_EQ(outcome.out, "");
  }
}

// The same bytes for every number of threads; a file tells how many emitters it keeps.
TEST_F(Dim, FilesAreTheSameForAnyNumberOfThreads) {
  Solve({"--by-emitter", "--threads", "1"});
  const std::string one = ReadBytes(sandbox_.Path("a.h5"));
  Solve({"--by-emitter", "--threads", "2"});
  EXPECT_EQ(one, ReadBytes(sandbox_.Path("a.h5")));
  const json info = json::parse(sandbox_.Run({"info", "a.h5", "--json"}).out);
  EXPECT_EQ(info["solution"]["tables"]["emitters"], 2);
  EXPECT_EQ(info["solution"]["options"]["by_emitter"], true);
}

// The report counts the interactions of the transport operator: links by what blocks them, or rays.
TEST(Report, CountsInteractions) {
  const Sandbox sandbox;
  const auto interactions = [&](const std::string& solver, const std::vector<std::string>& more) {
    const Outcome outcome = sandbox.Run(With({"solve", "floating-cube", "--error", "0.5", "--error-points",
                                              "10", "--solver", solver, "--report", "r.json"},
                                             more));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json::parse(ReadBytes(sandbox.Path("r.json")));
  };
  json report = interactions("hierarchical", {});
  EXPECT_EQ(report["interactions"]["smooth"], report["counts"]["links_visible"]);
  EXPECT_EQ(report["interactions"]["sharp"], report["counts"]["links_partial"]);
  EXPECT_EQ(report["interactions"]["sampled"], 0);
  EXPECT_GT(report["interactions"]["sharp"], 0);
  report = interactions("sampled", {});
  EXPECT_EQ(report["interactions"]["smooth"], 0);
  EXPECT_EQ(
      report["interactions"]["sampled"].get<std::size_t>() % report["counts"]["leaves"].get<std::size_t>(),
      0U);
  EXPECT_GT(report["interactions"]["sampled"], 0);
  // Four times the elements make sixteen times the pairs.
  const json coarse = interactions("dense", {"--divisions", "1"})["interactions"],
             fine = interactions("dense", {"--divisions", "2"})["interactions"];
  for (const char* kind : {"smooth", "sharp"})
    EXPECT_EQ(fine[kind].get<int>(), 16 * coarse[kind].get<int>()) << kind;
  EXPECT_GT(coarse["smooth"], 0);
}

}  // namespace
}  // namespace penumbra
