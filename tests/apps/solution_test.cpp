// What `solve -o` keeps serves the other commands at once, to the byte.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "tests/apps/run_program.h"

namespace penumbra {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kPoints = "x,y,z,nx,ny,nz\n0.3,-0.9,0,0,0,1\n0.1,-0.5,0.2,0.3,0.2,1\n";

// Options that do not follow from the error, so that all of them have to come back.
std::vector<std::string> Solving(std::vector<std::string> command) {
  const std::vector<std::string> options = {"--error",
                                            "0.3",
                                            "--eps",
                                            "0.031",
                                            "--min-discontinuity-weight",
                                            "0.7",
                                            "--min-wanted-weight",
                                            "0.6",
                                            "--corner-divisions",
                                            "2",
                                            "--max-leaf-dsets",
                                            "3",
                                            "--nudge",
                                            "0.00001",
                                            "--corrections",
                                            "1",
                                            "--max-reflectance",
                                            "0.7",
                                            "--error-points",
                                            "50"};
  command.insert(command.end(), options.begin(), options.end());
  return command;
}

// Pictures in every mode, probes and what info says are the same from the file as from the scene.
TEST(Solution, ServesLikeItsScene) {
  const Sandbox sandbox;
  sandbox.Write("points.csv", kPoints);
  const Outcome solve =
      sandbox.Run(Solving({"solve", "floating-cube", "-o", "a.h5", "--report", "solve.json"}));
  ASSERT_EQ(solve.status, 0) << solve.err;
  EXPECT_EQ(solve.out, "");
  // For any number of threads, at any time.
  ASSERT_EQ(sandbox.Run(Solving({"solve", "floating-cube", "-o", "b.h5", "--threads", "1"})).status, 0);
  EXPECT_EQ(ReadBytes(sandbox.Path("a.h5")), ReadBytes(sandbox.Path("b.h5")));

  for (const char* mode :
       {"interpolant", "gouraud-mesh", "gouraud", "flat", "rho", "exact", "lerp", "nodal", "bicubic"}) {
    const std::vector<std::string> picture = {"--mode", mode, "--size", "48x36", "--camera", "low"};
    std::vector<std::string> stored = {"render", "a.h5", "-o", "a.exr"},
                             anew = {"render", "floating-cube", "-o", "b.exr"};
    stored.insert(stored.end(), picture.begin(), picture.end());
    anew.insert(anew.end(), picture.begin(), picture.end());
    const Outcome from_file = sandbox.Run(stored);
    ASSERT_EQ(from_file.status, 0) << from_file.err;
    EXPECT_EQ(from_file.err, "");
    ASSERT_EQ(sandbox.Run(Solving(anew)).status, 0);
    EXPECT_EQ(ReadBytes(sandbox.Path("a.exr")), ReadBytes(sandbox.Path("b.exr"))) << mode;
  }

  const Outcome probe = sandbox.Run({"probe", "a.h5", "--points", "points.csv", "--parts"});
  ASSERT_EQ(probe.status, 0) << probe.err;
  EXPECT_EQ(probe.out,
            sandbox.Run(Solving({"probe", "floating-cube", "--points", "points.csv", "--parts"})).out);
  for (const char* method : {"clipping", "backprojection", "vertex-tracing"})
    EXPECT_EQ(sandbox.Run({"probe", "a.h5", "--points", "points.csv", "--method", method}).status, 0)
        << method;
  const Outcome direct = sandbox.Run({"probe", "a.h5", "--points", "points.csv", "--direct"});
  EXPECT_EQ(direct.status, 0) << direct.err;
  EXPECT_THAT(direct.out, HasSubstr("nan"));

  const json info = json::parse(sandbox.Run({"info", "a.h5", "--json"}).out);
  json scene = json::parse(sandbox.Run({"info", "floating-cube", "--json", "--max-reflectance", "0.7"}).out);
  // Only what was read from a text has digits.
  for (const char* of_text : {"coordinate_step", "plane_tolerance"}) scene.erase(of_text);
  for (const auto& [key, value] : scene.items()) EXPECT_EQ(info[key], value) << key;
  const json report = json::parse(ReadBytes(sandbox.Path("solve.json")));
  const json& solution = info["solution"];
  EXPECT_EQ(solution["report"]["counts"], report["counts"]);
  EXPECT_EQ(solution["report"]["error"], report["error"]);
  EXPECT_EQ(solution["report"]["energy"], report["energy"]);
  EXPECT_EQ(solution["options"]["eps"], 0.031);
  EXPECT_EQ(solution["options"]["max_reflectance"], 0.7);
  EXPECT_EQ(solution["tables"]["mesh_triangles"], report["counts"]["triangles"]);
  EXPECT_EQ(solution["triangles"], report["diagnostics"]["triangles"]);
  EXPECT_EQ(solution["tables"]["links"], report["counts"]["links"]);
  EXPECT_THAT(sandbox.Run({"info", "a.h5"}).out,
              testing::AllOf(HasSubstr("solved by"), HasSubstr("median angle")));

  // A report about a run from the file tells what came out when it was solved.
  ASSERT_EQ(sandbox.Run({"render", "a.h5", "-o", "a.png", "--size", "8x6", "--report", "r.json"}).status, 0);
  const json again = json::parse(ReadBytes(sandbox.Path("r.json")));
  EXPECT_EQ(again["error"], report["error"]);
  EXPECT_EQ(again["diagnostics"], report["diagnostics"]);
}

// A limit that ends a solve before there are interpolants is told, once; what is left can be kept, opened,
// and shown by interpolants that are made then.
TEST(Solution, IsKeptWhenALimitEndsTheSolve) {
  const Sandbox sandbox;
  sandbox.Write("points.csv", kPoints);
  for (const auto& [option, value] : {std::pair("--time-limit", "1e-9"), {"--memory-limit", "1"}}) {
    const Outcome solve =
        sandbox.Run({"solve", "floating-cube", "--error", "0.3", option, value, "-o", "a.h5"});
    ASSERT_EQ(solve.status, 0) << solve.err;
    EXPECT_THAT(solve.err, HasSubstr("; mesh: ended by the"));
    ASSERT_EQ(sandbox.Run({"solve", "floating-cube", option, value, "--report", "r.json"}).status, 0);
    const json report = json::parse(ReadBytes(sandbox.Path("r.json")));
    std::set<std::string> lines;
    for (const json& line : report["unmet"])
      EXPECT_TRUE(lines.insert(line.get<std::string>()).second) << line;
    EXPECT_EQ(report["phases"].size(), 6U);

    const Outcome info = sandbox.Run({"info", "a.h5"});
    EXPECT_EQ(info.status, 0) << info.err;
    for (const char* mode : {"interpolant", "flat", "exact"}) {
      const Outcome render = sandbox.Run({"render", "a.h5", "--mode", mode, "-o", "a.png", "--size", "8x6"});
      EXPECT_EQ(render.status, 0) << render.err;
    }
    const Outcome probe = sandbox.Run({"probe", "a.h5", "--points", "points.csv"});
    ASSERT_EQ(probe.status, 0) << probe.err;
  }
}

// A name is bytes, which need not be text: what is kept and told of it is.
TEST(Solution, IsKeptOfASceneOfAnyName) {
  const Sandbox sandbox;
  const std::string scene = "b\xff.obj", solution = "s\xfe.h5";
  sandbox.Write(scene, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const Outcome solve = sandbox.Run({"solve", scene, "-o", solution, "--report", "a.json", "-v"});
  ASSERT_EQ(solve.status, 0) << solve.err;
  EXPECT_THAT(solve.err, HasSubstr(scene));
  const Outcome info = sandbox.Run({"info", solution, "--json", "--report", "b.json", "-v"});
  ASSERT_EQ(info.status, 0) << info.err;
  EXPECT_EQ(json::parse(info.out)["faces"], 1);
  for (const char* name : {"a.json", "b.json"})
    EXPECT_TRUE(json::parse(ReadBytes(sandbox.Path(name)))["options"].is_object());
}

// Reflectances need no light: nothing is solved for them, and the picture is the same.
TEST(Solution, IsNotMadeForReflectances) {
  const Sandbox sandbox;
  const Outcome alone = sandbox.Run(
      {"render", "floating-cube", "--mode", "rho", "-o", "a.png", "--size", "48x36", "--time-limit", "1e-9"});
  ASSERT_EQ(alone.status, 0) << alone.err;
  EXPECT_EQ(alone.err, "");  // there is nothing that a limit could end
  ASSERT_EQ(sandbox
                .Run({"render", "floating-cube", "--mode", "rho", "-o", "b.png", "--size", "48x36", "--error",
                      "0.3", "--report", "r.json"})
                .status,
            0);
  EXPECT_EQ(ReadBytes(sandbox.Path("a.png")), ReadBytes(sandbox.Path("b.png")));
}

// What is no whole solution is refused in one line, with status 1, and nothing is written.
TEST(Solution, IsRefusedWhenDamaged) {
  const Sandbox sandbox;
  ASSERT_EQ(sandbox.Run({"solve", "furnace", "--error", "0.5", "-o", "a.h5"}).status, 0);
  const std::string whole = ReadBytes(sandbox.Path("a.h5"));
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
  sandbox.Write("flipped", flipped);
  std::string first = whole;
  first[0] = 'v';
  sandbox.Write("first", first);
  sandbox.Write("half", whole.substr(0, whole.size() / 2));
  sandbox.Write("short", whole.substr(0, 100));
  sandbox.Write("foreign", whole.substr(512));
  sandbox.Write("zeros", std::string(1000, '\0'));
  sandbox.Write("empty", "");
  const std::vector<std::string> files = sandbox.Files();
  for (const char* name : {"flipped", "first", "half", "short", "foreign", "zeros", "empty"})
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"info", name}, {"render", name, "-o", "x.png"}, {"solve", name, "-o", "x.h5"}}) {
      const Outcome outcome = sandbox.Run(command);
      EXPECT_EQ(outcome.status, 1) << name;
      EXPECT_THAT(outcome.err, testing::StartsWith(std::string(name) + ": error: "));
      EXPECT_THAT(Lines(outcome.err), testing::SizeIs(1));
      EXPECT_EQ(outcome.out, "");
    }
  EXPECT_EQ(sandbox.Files(), files);
}

// Options of reading and solving a scene mean nothing to a solution; a text file is a scene, whatever its
// name.
TEST(Solution, RefusesOptionsOfItsScene) {
  const Sandbox sandbox;
  ASSERT_EQ(sandbox.Run({"solve", "furnace", "--error", "0.5", "-o", "a.obj"}).status, 0);
  for (const std::vector<std::string>& option : std::vector<std::vector<std::string>>{
           {"--error", "0.1"}, {"--two-sided"}, {"--max-reflectance", "0.3"}, {"--no-acceleration"}}) {
    std::vector<std::string> command = {"render", "a.obj", "-o", "x.png"};
    command.insert(command.end(), option.begin(), option.end());
    const Outcome outcome = sandbox.Run(command);
    EXPECT_EQ(outcome.status, 2) << option[0];
    EXPECT_THAT(outcome.err, HasSubstr(option[0].substr(option[0] == "--no-acceleration" ? 5 : 0)));
  }
  EXPECT_EQ(sandbox.Run({"solve", "a.obj"}).status, 2);
  EXPECT_EQ(sandbox.Run({"info", "a.obj", "--threads", "1", "-v"}).status, 0);
  EXPECT_THAT(sandbox.Files(), ElementsAre("a.obj"));
  sandbox.Write("scene.h5", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(sandbox.Run({"info", "scene.h5"}).status, 0);
}

// A run that is killed leaves the old file whole.
TEST(Solution, SurvivesAKilledRun) {
  using namespace std::chrono_literals;
  const Sandbox sandbox;
  ASSERT_EQ(sandbox.Run({"solve", "furnace", "--error", "0.5", "-o", "a.h5"}).status, 0);
  const std::string old = ReadBytes(sandbox.Path("a.h5"));
  const Outcome killed = sandbox.RunAndSignal({"solve", "office", "--error", "0.01", "-v", "-o", "a.h5"},
                                              "Options used", SIGKILL);
  EXPECT_EQ(killed.status, -1);
  EXPECT_EQ(ReadBytes(sandbox.Path("a.h5")), old);
  EXPECT_EQ(sandbox.Run({"info", "a.h5"}).status, 0);
}

}  // namespace
}  // namespace penumbra
