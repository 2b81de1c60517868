// `--restart`: the light of other materials over the links of a solution.

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

constexpr const char* kRestartPoints =
    "x,y,z,nx,ny,nz\n0.3,-0.9,0,0,0,1\n0.1,-0.5,0.2,0.3,0.2,1\n-0.7,0.4,0,0,0,1\n";

json ReadJson(const Sandbox& sandbox, const std::string& name) {
  return json::parse(ReadBytes(sandbox.Path(name)));
}

// The six values of each point that the solution in the file gives.
std::vector<double> Probe(const Sandbox& sandbox, const std::string& solution) {
  const Outcome outcome = sandbox.Run({"probe", solution, "--points", "points.csv"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::vector<double> values;
  const std::vector<std::string> lines = Lines(outcome.out);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = Fields(lines[i]);
    for (std::size_t k = 7; k < fields.size(); ++k) values.push_back(std::stod(fields[k]));
  }
  return values;
}

// How far the values are from others, relative to those; those that are NaN have to be in both.
double Difference(const std::vector<double>& values, const std::vector<double>& others) {
  EXPECT_EQ(values.size(), others.size());
  double worst = 0;
  for (std::size_t i = 0; i < std::min(values.size(), others.size()); ++i) {
    EXPECT_EQ(std::isnan(values[i]), std::isnan(others[i]));
    if (!std::isnan(others[i])) worst = std::max(worst, std::abs(values[i] - others[i]) / others[i]);
  }
  return worst;
}

// Gathering ends at this residual, and with it the light of two solves over the same links agrees but for a
// few times as much.
constexpr const char* kCutoff = "1e-10";
constexpr double kEqualIrradiance = 1e-8;

// In a closed room of one material irradiance is E / (1 - rho) everywhere, whatever the material was when its
// links were made.
TEST(Restart, FurnaceOfAnotherMaterial) {
  const Sandbox sandbox;
  sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n0.3,0.1,0,0,0,1\n0.5,1,0.99,0,-1,0\n0.6,0.2,0.7,1,2,3\n");
  ASSERT_EQ(sandbox.Run({"solve", "furnace", "--error", "0.1", "-o", "a.h5"}).status, 0);
  // The links are coarse: each correction leaves some hundredths of what the last one left.
  const Outcome restart = sandbox.Run(
      {"solve", "furnace", "--emittance", "glow=3,1,0.5", "--reflectance", "glow=0.25,0.5,0.75", "--restart",
       "a.h5", "--relative-cutoff", kCutoff, "--refine", "transport", "--corrections", "12", "-o", "b.h5"});
  ASSERT_EQ(restart.status, 0) << restart.err;
  const std::vector<double> values = Probe(sandbox, "b.h5");
  std::vector<double> want;
  for (int i = 0; i < 6; ++i) want.insert(want.end(), {4, 2, 2});
  // The last point is in the air, where there is no interpolant.
  for (int i = 15; i < 18; ++i) want[i] = NAN;
  const double worst = Difference(values, want);
  std::printf("worst relative error %.2g\n", worst);
  EXPECT_LE(worst, kEqualIrradiance);
}

// Twice the light and twice the eps make the same links: over those of the scene as it was, the light is that
// of solving the changed scene anew. Whatever changed comes back when the change is taken back. Restarting
// from a restart is the same as from the first, the links are never touched, and the bytes are the same for
// every number of threads.
TEST(Restart, AgreesWithSolvingAnew) {
  const Sandbox sandbox;
  sandbox.Write("points.csv", kRestartPoints);
  const std::vector<std::string> solving = {"--error",        "0.3", "--relative-cutoff", kCutoff,
                                            "--error-points", "50"},
                                 brighter = {"--emittance", "left_light=600,540,420", "--emittance",
                                             "right_light=360,420,520"},
                                 other = {"--reflectance",     "cube=0.1,0.2,0.3", "--reflectance",
                                          "plane=0.2,0.2,0.6", "--emittance",      "left_light=0,0,9"};
  const auto solve = [&](const std::string& name, const std::vector<std::string>& changes,
                         const std::vector<std::string>& how) {
    const Outcome outcome = sandbox.Run(
        With(With(With({"solve", "floating-cube", "-o", name + ".h5", "--report", name + ".json"}, solving),
                  changes),
             how));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  };
  solve("first", {}, {"--eps", "0.5"});
  solve("anew", brighter, {"--eps", "1"});
  solve("over", brighter, {"--restart", "first.h5"});
  solve("other", other, {"--restart", "first.h5"});
  solve("back", {}, {"--restart", "other.h5", "--threads", "1"});
  solve("again", {}, {"--restart", "other.h5", "--threads", "2"});

  const json first = ReadJson(sandbox, "first.json");
  EXPECT_GT(first["counts"]["elements"].get<int>(), 3 * first["counts"]["patches"].get<int>());
  for (const char* name : {"anew", "over", "other", "back"}) {
    const json report = ReadJson(sandbox, std::string(name) + ".json");
    for (const char* count : {"elements", "links", "links_partial"})
      EXPECT_EQ(report["counts"][count], first["counts"][count]) << name << " " << count;
  }
  const json over = ReadJson(sandbox, "over.json");
  EXPECT_EQ(over["options"]["restart"], "first.h5");
  EXPECT_EQ(over["options"]["eps"], 0.5);
  ASSERT_EQ(over["iterations"].size(), 1U);
  EXPECT_LE(over["iterations"][0]["residual"].get<double>(), std::stod(kCutoff));
  EXPECT_EQ(over["iterations"][0]["links_split"], 0);

  const double anew = Difference(Probe(sandbox, "over.h5"), Probe(sandbox, "anew.h5")),
               back = Difference(Probe(sandbox, "back.h5"), Probe(sandbox, "first.h5")),
               changed = Difference(Probe(sandbox, "other.h5"), Probe(sandbox, "first.h5"));
  std::printf("against solving anew %.2g, taken back %.2g, changed by %.2g\n", anew, back, changed);
  EXPECT_LE(anew, kEqualIrradiance);
  EXPECT_LE(back, kEqualIrradiance);
  EXPECT_GT(changed, 0.1);
  EXPECT_EQ(ReadBytes(sandbox.Path("back.h5")), ReadBytes(sandbox.Path("again.h5")));
  EXPECT_THAT(sandbox.Run({"info", "over.h5"}).out, HasSubstr("solved by"));
}

// Whoever solves may begin with the links of a solution: the result is that of the solution made so, to the
// byte.
TEST(Restart, ServesEveryCommandThatSolves) {
  const Sandbox sandbox;
  sandbox.Write("points.csv", kRestartPoints);
  const std::vector<std::string> how = {
      "--error", "0.5", "--error-points", "10", "--emittance", "left_light=0,0,9", "--restart", "first.h5"};
  ASSERT_EQ(sandbox.Run({"solve", "floating-cube", "--error", "0.5", "-o", "first.h5"}).status, 0);
  ASSERT_EQ(sandbox.Run(With({"solve", "floating-cube", "-o", "over.h5"}, how)).status, 0);
  for (const auto& [command, output] :
       {std::pair(std::vector<std::string>{"render", "--size", "8x6"}, "a.png"),
        {{"probe", "--points", "points.csv"}, "a.csv"},
        {{"export"}, "a.ply"}}) {
    const Outcome over = sandbox.Run(With(command, {"over.h5", "-o", std::string("over-") + output}));
    EXPECT_EQ(over.status, 0) << over.err;
    const Outcome scene = sandbox.Run(With(With(command, {"floating-cube", "-o", output}), how));
    EXPECT_EQ(scene.status, 0) << scene.err;
    EXPECT_EQ(ReadBytes(sandbox.Path(output)), ReadBytes(sandbox.Path(std::string("over-") + output)));
  }
}

// `info` solves where a report is asked for, and only there; of a solution it is the report of its solve.
TEST(Info, ReportsOnTheSolve) {
  const Sandbox sandbox;
  const std::vector<std::string> how = {"--error", "0.5", "--error-points", "10"};
  ASSERT_EQ(sandbox.Run(With({"solve", "floating-cube", "-o", "a.h5", "--report", "solve.json"}, how)).status,
            0);
  const json solved = ReadJson(sandbox, "solve.json");
  const Outcome scene = sandbox.Run(With({"info", "floating-cube", "--report", "scene.json"}, how)),
                solution = sandbox.Run({"info", "a.h5", "--report", "solution.json"});
  EXPECT_EQ(scene.status, 0) << scene.err;
  EXPECT_EQ(scene.out, sandbox.Run({"info", "floating-cube"}).out);
  EXPECT_EQ(solution.status, 0) << solution.err;
  EXPECT_EQ(solution.out, sandbox.Run({"info", "a.h5"}).out);
  for (const char* name : {"scene.json", "solution.json"})
    for (const char* part : {"counts", "energy", "error"})
      EXPECT_EQ(ReadJson(sandbox, name)[part], solved[part]) << name << " " << part;
  EXPECT_EQ(sandbox.Run({"info", "floating-cube", "--report", "no/where.json"}).status, 1);
}

// What cannot be is refused in one line that says why, and nothing is written.
TEST(Restart, RefusesWhatDoesNotFit) {
  const Sandbox sandbox;
  ASSERT_EQ(sandbox.Run({"solve", "furnace", "--error", "0.5", "-o", "a.h5"}).status, 0);
  ASSERT_EQ(
      sandbox.Run({"solve", "furnace", "--solver", "dense", "--divisions", "1", "-o", "dense.h5"}).status, 0);
  sandbox.Write("text", "no solution\n");
  // Its faces are others; the first is the same.
  sandbox.Write("other.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nf 1 2 3 4\nf 1 5 6 2\n");
  const std::vector<std::string> files = sandbox.Files();
  struct Case {
    std::vector<std::string> arguments;
    int status;
    std::string says;
  };
  for (const Case& c :
       {Case{{"other.obj", "--restart", "a.h5"}, 1, "a.h5: error: it is no solution of"},
        Case{{"furnace", "--two-sided", "--restart", "a.h5"}, 1, "6 faces against 12"},
        Case{{"furnace", "--restart", "none.h5"}, 1, "none.h5: error: there is no such file"},
        Case{{"furnace", "--restart", "text"}, 1, "text: error: it is no solution"},
        Case{{"furnace", "--restart", "dense.h5"}, 1, "dense.h5: error: the dense solver"},
        Case{{"a.h5", "--restart", "a.h5"}, 2, "'a.h5' is a solution"},
        Case{{"furnace", "--restart", "a.h5", "--eps", "1"}, 2, "--eps says how links"},
        Case{{"furnace", "--restart", "a.h5", "--solver", "dense"}, 2, "--solver says how"}}) {
    const Outcome outcome = sandbox.Run(With(With({"solve"}, c.arguments), {"-o", "x.h5"}));
    EXPECT_EQ(outcome.status, c.status) << c.says;
    EXPECT_THAT(outcome.err, HasSubstr(c.says));
    EXPECT_EQ(outcome.out, "");
    if (c.status == 1) {
      EXPECT_THAT(Lines(outcome.err), testing::SizeIs(1));
    }
  }
  EXPECT_EQ(sandbox.Files(), files);
}

}  // namespace
}  // namespace penumbra
