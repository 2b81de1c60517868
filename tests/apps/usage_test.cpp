// How the program meets its users: help, bad usage, bad input, interrupts.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <thread>

#include "tests/apps/run_program.h"

namespace penumbra {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::SizeIs;

// Every command's help names its options, with their defaults, and ends with status 0.
TEST(Help, ListsEveryOption) {
  const Sandbox sandbox;
  const std::vector<std::string> common = {
      "--emission-is-radiance", "--two-sided", "--max-reflectance", "--threads", "--seed", "--verbose"};
  const std::vector<std::string> solving = {"--error X=0.02",
                                            "--eps",
                                            "--min-area",
                                            "--min-discontinuity-weight",
                                            "--min-wanted-weight",
                                            "--corner-divisions N=0",
                                            "--max-leaf-dsets",
                                            "--weight",
                                            "--eee X=0",
                                            "--discontinuities",
                                            "--keep-hidden-discontinuities",
                                            "--relative-cutoff",
                                            "--error-points",
                                            "--iterations"};
  const std::vector<std::pair<std::string, std::vector<std::string>>> own = {
      {"solve", {"--report", "--restart"}},
      {"render",
       {"--output", "--mode", "--eye", "--look-at", "--up", "--fov", "--size", "--exposure", "--camera",
        "--benchmark", "--report", "--false-colour", "--scale-max", "--split", "--backend",
        "--opengl-coordinates", "--supersampling", "--samples", "--restart"}},
      {"probe", {"--points", "--direct", "--output", "--report", "--restart"}},
      {"export", {"--output", "--exposure", "--camera", "--report", "--restart"}},
      {"view", {"--script", "--no-solve", "--help-script", "--camera", "--eye", "--restart"}},
      {"info", {"--json", "--report", "--restart"}}};
  const Outcome form_factor = sandbox.Run({"form-factor", "--help"});
  EXPECT_EQ(form_factor.status, 0);
  for (const char* option :
       {"--from", "--to", "--method", "--tolerance", "--rays", "--threads", "--two-sided"})
    EXPECT_THAT(form_factor.out, HasSubstr(option));
  for (const auto& [command, options] : own) {
    const Outcome help = sandbox.Run({command, "--help"});
    EXPECT_EQ(help.status, 0);
    for (const auto* list : {&common, &solving, &options})
      for (const std::string& option : *list) EXPECT_THAT(help.out, HasSubstr(option)) << command;
  }
  const Outcome diff = sandbox.Run({"diff", "--help"});
  EXPECT_EQ(diff.status, 0);
  for (const char* option : {"--output", "--pixels-per-degree", "--json", "--threads", "--seed", "--verbose"})
    EXPECT_THAT(diff.out, HasSubstr(option));
  const Outcome program = sandbox.Run({"--help"});
  EXPECT_EQ(program.status, 0);
  for (const char* command : {"solve", "render", "probe", "form-factor", "export", "diff", "info", "scenes"})
    EXPECT_THAT(program.out, HasSubstr(command));
}

// The version is a line on standard output.
TEST(Help, PrintsTheVersion) {
  const Outcome version = Sandbox().Run({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, MatchesRegex("penumbra [0-9]+\\.[0-9]+\\.[0-9]+( \\([0-9a-f]+\\+?\\))?\n"));
}

// The built-in scenes are listed, a line each, the name first.
TEST(Scenes, AreListed) {
  const Outcome list = Sandbox().Run({"scenes"});
  EXPECT_EQ(list.status, 0);
  for (const char* name : {"office", "cornell", "floating-cube", "furnace"})
    EXPECT_THAT("\n" + list.out, HasSubstr(std::string("\n") + name + " "));
}

// Commands that cannot be meant.
const std::vector<std::vector<std::string>> kBadUsage = {
    {},
    {"no-such-command"},
    {"solve"},
    {"solve", "furnace", "--no-such-option"},
    {"solve", "furnace", "extra"},
    {"solve", "furnace", "--error", "0"},
    {"solve", "furnace", "--error", "-1"},
    {"solve", "furnace", "--error", "nan"},
    {"solve", "furnace", "--error", "inf"},
    {"solve", "furnace", "--error", "0.1x"},
    {"solve", "furnace", "--error", ""},
    {"solve", "furnace", "--error"},
    {"solve", "furnace", "--eps", "0"},
    {"solve", "furnace", "--min-area", "-1"},
    {"solve", "furnace", "--threads", "-1"},
    {"solve", "furnace", "--threads", "1.5"},
    {"solve", "furnace", "--seed", "-1"},
    {"solve", "furnace", "--iterations", "0"},
    {"solve", "furnace", "--error-points", "-1"},
    {"solve", "furnace", "--max-reflectance", "1"},
    {"solve", "furnace", "--emittance", "glow=1e101,0,0"},
    {"solve", "furnace", "--basis", "linear"},
    {"solve", "furnace", "--solver", "hierarchical", "--basis", "linear"},
    {"solve", "furnace", "--divisions", "2"},
    {"export", "furnace", "-o", "furnace2.obj", "--report", "r.json"},
    {"render", "furnace"},
    {"render", "furnace", "-o", "image.jpg"},
    {"render", "furnace", "-o", "image"},
    {"render", "furnace", "-o", "image.png", "--mode", "phong"},
    {"render", "furnace", "-o", "image.png", "--mode", "exact", "--samples", "0"},
    {"render", "furnace", "-o", "image.png", "--size", "0x10"},
    {"render", "furnace", "-o", "image.png", "--size", "10"},
    {"render", "furnace", "-o", "image.png", "--size", "10x-10"},
    {"render", "furnace", "-o", "image.png", "--size", "30000x30000"},
    {"render", "furnace", "-o", "image.png", "--exposure", "0"},
    {"render", "furnace", "-o", "image.png", "--fov", "180"},
    {"render", "furnace", "-o", "image.png", "--fov", "0"},
    {"render", "furnace", "-o", "image.png", "--eye", "1,2"},
    {"render", "furnace", "-o", "image.png", "--eye", "1,2,3,4"},
    {"render", "furnace", "-o", "image.png", "--eye", "1,2,nan"},
    {"render", "furnace", "-o", "image.png", "--eye", "1,2,3", "--look-at", "1,2,3"},
    {"render", "furnace", "-o", "image.png", "--camera", "no-such-camera"},
    {"render", "furnace", "-o", "image.exr", "--false-colour"},
    {"render", "furnace", "-o", "image.exr", "--split"},
    {"render", "furnace", "-o", "image.png", "--scale-max", "5"},
    {"render", "furnace", "-o", "image.png", "--split", "--mode", "exact"},
    {"render", "furnace", "-o", "image.png", "--backend", "opengl", "--mode", "lerp"},
    {"render", "furnace", "-o", "image.png", "--backend", "direct3d"},
    {"render", "furnace", "--benchmark", "0"},
    {"probe", "furnace"},
    {"probe", "furnace", "--points", "p.csv", "--method", "guess"},
    {"form-factor", "furnace", "--from", "0"},
    {"form-factor", "furnace", "--to", "0"},
    {"form-factor", "furnace", "--from", "0", "--to", "1", "--method", "guess"},
    {"form-factor", "furnace", "--from", "0", "--to", "1", "--method", "sampled"},
    {"form-factor", "furnace", "--from", "0", "--to", "1", "--tolerance", "0"},
    {"form-factor", "furnace", "--from", "0", "--to", "1", "--rays", "0"},
    {"probe", "furnace", "--points", "p.csv", "--direct", "--report", "r.json"},
    {"probe", "furnace", "--points", "p.csv", "--direct", "--restart", "a.h5"},
    {"export", "furnace", "-o", "furnace2.obj", "--restart", "a.h5"},
    // out of range
    {"solve", "furnace", "--error", "1e-300"},
    {"solve", "furnace", "--source-error", "1e-300"},
    {"solve", "furnace", "--eps", "1e-300"},
    {"solve", "furnace", "--relative-cutoff", "2"},
    {"solve", "furnace", "--nudge", "0.3"},
    {"solve", "furnace", "--nudge", "nan"},
    {"solve", "furnace", "--source-push-off", "1"},
    {"solve", "furnace", "--eee", "1e-300"},
    {"solve", "furnace", "--time-limit", "1e300"},
    {"solve", "furnace", "--min-backprojection-segment", "2"},
    {"form-factor", "furnace", "--from", "0", "--to", "1", "--tolerance", "1e-300"},
    {"render", "furnace", "-o", "image.png", "--eye", "1e300,0,0"},
    {"render", "furnace", "-o", "image.png", "--fov", "1e-300"},
    {"render", "furnace", "-o", "image.png", "--exposure", "1e300"},
    // at odds with each other
    {"solve", "furnace", "--solver", "dense", "--oracle", "transport"},
    {"solve", "furnace", "--solver", "dense", "--eps", "1"},
    {"solve", "furnace", "--solver", "dense", "--no-acceleration"},
    {"solve", "furnace", "--corrections", "0", "--source-error", "0.1"},
    {"render", "furnace", "-o", "image.png", "--split", "--false-colour"},
    {"render", "furnace", "-o", "image.png", "--split", "--supersampling", "4"},
    {"render", "furnace", "-o", "image.exr", "--supersampling", "4"},
    {"render", "furnace", "-o", "image.png", "--samples", "4"},
    {"render", "furnace", "-o", "image.png", "--mode", "exact", "--supersampling", "4"},
    {"render", "furnace", "-o", "image.png", "--opengl-coordinates", "8bit"},
    {"render", "furnace", "-o", "image.png", "--up", "0,0,0"},
    {"render", "furnace", "-o", "image.png", "--eye", "0,0,0", "--look-at", "0,0,1", "--up", "0,0,-2"},
    {"probe", "furnace", "--points", "p.csv", "--method", "clipping", "--min-backprojection-segment", "0.1"},
    {"form-factor", "furnace", "--from", "0", "--to", "1", "--method", "disk", "--tolerance", "0.1"},
    {"form-factor", "furnace", "--from", "0", "--to", "1", "--rays", "10"},
    {"export", "furnace", "-o", "furnace.vtu", "--exposure", "1"},
    {"export", "furnace", "-o", "furnace.ply", "--eye", "1,1,1"},
};

// Bad usage is told in one line before any work is done, with exit status 2, and writes nothing.
TEST(Usage, BadUsageEndsWithTwo) {
  const Sandbox sandbox;
  for (const std::vector<std::string>& arguments : kBadUsage) {
    const Outcome outcome = sandbox.Run(arguments);
    EXPECT_EQ(outcome.status, 2) << testing::PrintToString(arguments) << outcome.err;
    EXPECT_THAT(Lines(outcome.err), SizeIs(1)) << outcome.err;
    EXPECT_EQ(outcome.out, "") << testing::PrintToString(arguments);
  }
  EXPECT_THAT(sandbox.Files(), SizeIs(0));
}

struct BadScene {
  const char* name;
  const char* obj;
  const char* mtl;
  const char* message;  // the beginning of the line on standard error; FILE is scene.obj or scene.mtl
};

void PrintTo(const BadScene& bad, std::ostream* out) { *out << bad.name; }

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

class BadScenes : public testing::TestWithParam<BadScene> {};

// Bad input of every kind gets one line that names file and line, status 1, and leaves outputs as they were.
TEST_P(BadScenes, GetOneLineAndLeaveOutputsAlone) {
  const Sandbox sandbox;
  sandbox.Write("scene.obj", GetParam().obj);
  if (*GetParam().mtl) sandbox.Write("scene.mtl", GetParam().mtl);
  const std::string points = sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n0,0,1,0,0,1\n");
  sandbox.Write("image.png", "old");
  sandbox.Write("report.json", "old");
  const std::vector<std::string> files = sandbox.Files();

  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"solve", "scene.obj", "--report", "report.json"},
           {"render", "scene.obj", "-o", "image.png", "--report", "report.json"},
           {"probe", "scene.obj", "--points", "points.csv", "-o", "image.png"},
           {"info", "scene.obj"}}) {
    const Outcome outcome = sandbox.Run(arguments);
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_THAT(Lines(outcome.err), ElementsAre(testing::StartsWith(GetParam().message)));
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_EQ(sandbox.Files(), files);
  EXPECT_EQ(ReadBytes(sandbox.Path("image.png")), "old");
  EXPECT_EQ(ReadBytes(sandbox.Path("report.json")), "old");
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, BadScenes,
    testing::Values(
        BadScene{"syntax", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3/x\n", "", "scene.obj:4: error: "},
        BadScene{"too_few_coordinates", "v 0 0\n", "", "scene.obj:1: error: "},
        BadScene{"index_too_large", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\n", "", "scene.obj:4: error: "},
        BadScene{"index_zero", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 0 1 2\n", "", "scene.obj:4: error: "},
        BadScene{"index_too_negative", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -4 -2 -1\n", "", "scene.obj:4: error: "},
        BadScene{"no_number", "v 0 zero 0\n", "", "scene.obj:1: error: "},
        BadScene{"not_a_number", "v 0 0 0\nv 0 nan 0\n", "", "scene.obj:2: error: "},
        BadScene{"infinity", "v 0 0 0\nv 0 inf 0\n", "", "scene.obj:2: error: "},
        BadScene{"overflow", "v 0 0 0\nv 0 1e999 0\n", "", "scene.obj:2: error: "},
        BadScene{"not_planar", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3 4\n", "",
                 "scene.obj:5: error: "},
        BadScene{"self_crossing", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 3 0 0\nf 1 3 2 4 5\n", "",
                 "scene.obj:6: error: "},
        BadScene{"reflectance_one", "mtllib scene.mtl\nusemtl white\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n",
                 "newmtl white\nKd 0.5 1 0.5\n", "scene.mtl:2: error: "},
        BadScene{"reflectance_negative",
                 "mtllib scene.mtl\nusemtl white\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n",
                 "newmtl white\nKd 0.5 -0.1 0.5\n", "scene.mtl:2: error: "},
        BadScene{"emittance_nan", "mtllib scene.mtl\nusemtl white\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n",
                 "newmtl white\nKd 0 0 0\nKe nan 0 0\n", "scene.mtl:3: error: "}),
    [](const auto& test_case) { return test_case.param.name; });

// A scene that is neither a file nor a built-in name is named in one line.
TEST(Input, MissingSceneIsNamed) {
  const Sandbox sandbox;
  const Outcome outcome = sandbox.Run({"render", "missing.obj", "-o", "image.png"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(Lines(outcome.err), ElementsAre(testing::StartsWith("missing.obj: error: ")));
  EXPECT_THAT(sandbox.Files(), SizeIs(0));
}

// A file wins over the name of a built-in scene; what was repaired in it is warned about, a line each.
TEST(Input, FileWinsOverBuiltInName) {
  const Sandbox sandbox;
  sandbox.Write("office", std::string(kSquare) + "f 1 2 2\n");
  const Outcome outcome = sandbox.Run({"info", "office"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("2, 1 of them dropped"));
  ASSERT_GE(Lines(outcome.err).size(), 1u);
  for (const std::string& line : Lines(outcome.err))
    EXPECT_THAT(line, testing::ContainsRegex("^office:([0-9]+:)? warning: "));
}

// Bad points get one line that names file and line, and status 1.
TEST(Input, BadPointsAreNamed) {
  const Sandbox sandbox;
  sandbox.Write("scene.obj", kSquare);
  const std::string header = "x,y,z,nx,ny,nz\n";
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"", "points.csv:1: error: "},
      {"x,y,z,nx\n0,0,0,1\n", "points.csv:1: error: "},
      {header + "0,0,0,0,0,1\n0,0,0,0,0\n", "points.csv:3: error: "},
      {header + "0,0,0,0,0,1,2\n", "points.csv:2: error: "},
      {header + "0,0,zero,0,0,1\n", "points.csv:2: error: "},
      {header + "0,0,,0,0,1\n", "points.csv:2: error: "},
      {header + "\n0,0,nan,0,0,1\n", "points.csv:3: error: "},
      {header + "0,0,1e999,0,0,1\n", "points.csv:2: error: "},
  };
  for (const auto& [text, message] : bad) {
    sandbox.Write("points.csv", text);
    const Outcome outcome = sandbox.Run({"probe", "scene.obj", "--points", "points.csv", "--direct"});
    EXPECT_EQ(outcome.status, 1) << text;
    EXPECT_THAT(Lines(outcome.err), ElementsAre(testing::StartsWith(message)));
    EXPECT_EQ(outcome.out, "");
  }
  // No normal, and on no face: told once the scene, with its warnings, has been read.
  sandbox.Write("points.csv", "x,y,z\n0,0,1\n");
  const Outcome in_space = sandbox.Run({"probe", "scene.obj", "--points", "points.csv", "--direct"});
  EXPECT_EQ(in_space.status, 1);
  EXPECT_THAT(Lines(in_space.err).back(), testing::StartsWith("points.csv:2: error: "));
  EXPECT_EQ(in_space.out, "");
  for (const std::string unreadable : {"missing.csv", "."}) {
    const Outcome outcome = sandbox.Run({"probe", "scene.obj", "--points", unreadable, "--direct"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(Lines(outcome.err), ElementsAre(testing::StartsWith(unreadable + ": error: ")));
  }
}

// A coordinate below all numbers is 0, as in scenes.
TEST(Input, TinyNumbersAreZero) {
  const Sandbox sandbox;
  sandbox.Write("scene.obj", kSquare);
  sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n0.5,0.5,1e-400,0,0,1\n");
  const Outcome outcome = sandbox.Run({"probe", "scene.obj", "--points", "points.csv", "--direct"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

// A pipe can be read once only, and that is enough.
TEST(Input, ScenesComeThroughPipes) {
  const Sandbox sandbox;
  ASSERT_EQ(mkfifo(sandbox.Path("pipe").c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(sandbox.Path("pipe")) << kSquare; });
  const Outcome outcome = sandbox.Run({"info", "pipe", "--json"});
  writer.join();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\"faces\": 1"));
}

// What is written takes the place of its own name alone, and of what a link points to.
TEST(Output, TouchesNoOtherFile) {
  const Sandbox sandbox;
  sandbox.Write("scene.obj", kSquare);
  sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n0.5,0.5,0,0,0,1\n");
  sandbox.Write("out.csv.tmp", "mine");
  sandbox.Write("kept.csv", "old");
  std::filesystem::create_symlink("kept.csv", sandbox.Path("link.csv"));
  std::filesystem::create_symlink("new.csv", sandbox.Path("to_nothing.csv"));
  for (const char* name : {"out.csv", "link.csv", "to_nothing.csv"}) {
    const Outcome outcome =
        sandbox.Run({"probe", "scene.obj", "--points", "points.csv", "--direct", "-o", name});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
  EXPECT_EQ(ReadBytes(sandbox.Path("out.csv.tmp")), "mine");
  EXPECT_TRUE(std::filesystem::is_symlink(sandbox.Path("link.csv")));
  EXPECT_TRUE(std::filesystem::is_symlink(sandbox.Path("to_nothing.csv")));
  EXPECT_EQ(ReadBytes(sandbox.Path("kept.csv")), ReadBytes(sandbox.Path("out.csv")));
  EXPECT_EQ(ReadBytes(sandbox.Path("new.csv")), ReadBytes(sandbox.Path("out.csv")));
  EXPECT_THAT(sandbox.Files(), SizeIs(8));
}

// The options used are told as they would be given: flags where they are set, under their own names.
TEST(Usage, OptionsUsedCanBeGivenAgain) {
  const Sandbox sandbox;
  const auto told = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"solve", "furnace", "--error", "0.5", "--error-points", "10", "-v"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return sandbox.Run(arguments).err;
  };
  const std::string plain = told({});
  for (const char* flag : {"--two-sided", "acceleration", "--multigrid", "true", "false"})
    EXPECT_THAT(plain, testing::Not(HasSubstr(flag)));
  const std::string set = told({"--two-sided", "--no-acceleration", "--emittance", "glow=1,2,0.5"});
  for (const char* line : {"   --two-sided\n", "   --no-acceleration\n", "   --emittance glow=1"})
    EXPECT_THAT(set, HasSubstr(line));
}

// The words of the block of options used, as a shell would read them.
std::vector<std::string> OptionsUsedIn(const std::string& err) {
  std::vector<std::string> words;
  bool inside = false;
  for (const std::string& line : Lines(err)) {
    if (inside && !line.starts_with("   ")) break;
    if (inside) {
      std::istringstream rest(line);
      for (std::string word; rest >> std::quoted(word, '\'');) words.push_back(word);
    }
    inside = inside || line.starts_with("Options used");
  }
  return words;
}

// Given again, they are the same options, whatever the command.
TEST(Usage, OptionsUsedGiveThemselves) {
  const Sandbox sandbox;
  sandbox.Write("p.csv", "x,y,z,nx,ny,nz\n0.5,0.5,0.5,0,0,1\n");
  ASSERT_EQ(sandbox.Run({"solve", "furnace", "--error", "0.5", "-o", "a.h5"}).status, 0);
  sandbox.Write("two words.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl dim glow\nf 1 2 3\n");
  sandbox.Write("a.mtl", "newmtl dim glow\nKe 1 1 1\n");
  struct Case {
    std::vector<std::string> command, options;
  };
  for (const Case& c : {
           Case{{"solve"}, {"furnace", "--error", "0.5"}},
           Case{{"solve"}, {"furnace", "--solver", "dense", "--basis", "linear", "--divisions", "1"}},
           Case{{"solve"},
                {"furnace", "--error", "0.5", "--two-sided", "--no-acceleration", "--bounces", "2"}},
           Case{{"solve"}, {"furnace", "--error", "0.5", "--restart", "a.h5", "--time-limit", "1000"}},
           Case{{"render", "-o", "a.png"}, {"furnace", "--error", "0.5", "--size", "8x6"}},
           Case{{"render", "-o", "a.png"}, {"furnace", "--mode", "rho", "--size", "8x6", "--exposure", "2"}},
           Case{{"probe", "--points", "p.csv"}, {"furnace", "--error", "0.5", "--parts"}},
           Case{{"probe", "--points", "p.csv"}, {"furnace", "--direct", "--emittance", "glow=1,2,0.5"}},
           Case{{"form-factor"}, {"furnace", "--from", "0", "--to", "1"}},
           Case{{"info"}, {"furnace", "--max-reflectance", "0.5"}},
           Case{{"probe", "--points", "p.csv"}, {"a.h5"}},
           Case{{"info"}, {"two words.obj", "--emittance", "dim glow=1,2,0.5"}},
       }) {
    const auto run = [&](const std::vector<std::string>& options) {
      std::vector<std::string> arguments = c.command;
      arguments.insert(arguments.end(), options.begin(), options.end());
      arguments.push_back("-v");
      return sandbox.Run(arguments);
    };
    const Outcome first = run(c.options);
    ASSERT_EQ(first.status, 0) << first.err;
    const std::vector<std::string> used = OptionsUsedIn(first.err);
    const Outcome again = run(used);
    ASSERT_EQ(again.status, 0) << testing::PrintToString(used) << again.err;
    EXPECT_THAT(OptionsUsedIn(again.err), testing::UnorderedElementsAreArray(used));
    EXPECT_EQ(again.out, first.out);
  }
}

// An output that cannot be written is told in one line, before the solve.
TEST(Output, UnwritablePlaceIsNamed) {
  const Sandbox sandbox;
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"render", "office", "--error", "1e-6", "-o", "missing/image.png"},
           {"render", "office", "--error", "1e-6", "-o", "image.png", "--report", "missing/report.json"},
           {"solve", "office", "--error", "1e-6", "--report", "."}}) {
    const Outcome outcome = sandbox.Run(arguments);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(Lines(outcome.err), SizeIs(1)) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("error: cannot write"));
  }
  EXPECT_THAT(sandbox.Files(), SizeIs(0));
}

// Whatever would be lost by it is no place for an output: what is read, its library, what else is written.
TEST(Output, IsNeverWhatIsReadOrAnotherOutput) {
  const Sandbox sandbox;
  const std::string room = "mtllib room.mtl\nusemtl warm\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string library = "newmtl warm\nKd 0.5 0.5 0.5\nKe 1 1 1\n";
  const std::string points = "x,y,z,nx,ny,nz\n0.2,0.2,1,0,0,-1\n";
  sandbox.Write("room.obj", room);
  sandbox.Write("room.mtl", library);
  sandbox.Write("p.csv", points);
  std::filesystem::create_symlink("room.obj", sandbox.Path("link.ply"));
  std::filesystem::create_hard_link(sandbox.Path("room.mtl"), sandbox.Path("hard.json"));
  std::filesystem::create_directory(sandbox.Path("sub"));
  const std::vector<std::string> before = sandbox.Files();
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"solve", "room.obj", "-o", "room.obj"},
           {"solve", "room.obj", "-o", "./sub/../room.obj"},
           {"solve", "room.obj", "-o", "room.mtl"},
           {"solve", "room.obj", "--report", "hard.json"},
           {"solve", "room.obj", "-o", "a", "--report", "a"},
           {"solve", "room.obj", "-o", "a", "--report", "./a"},
           {"export", "room.obj", "-o", "link.ply"},
           {"export", "room.obj", "-o", "room.obj"},
           {"export", "room.obj", "-o", "a.ply", "--report", "p.csv", "--report", "a.ply"},
           {"probe", "room.obj", "--points", "p.csv", "-o", "p.csv"},
           {"probe", "room.obj", "--points", "p.csv", "--direct", "-o", "room.obj"},
           {"info", "room.obj", "--report", "room.mtl"}}) {
    const Outcome outcome = sandbox.Run(arguments);
    EXPECT_EQ(outcome.status, 2) << testing::PrintToString(arguments) << outcome.err;
    EXPECT_THAT(Lines(outcome.err), SizeIs(1)) << outcome.err;
    EXPECT_EQ(sandbox.Files(), before);
  }
  EXPECT_EQ(ReadBytes(sandbox.Path("room.obj")), room);
  EXPECT_EQ(ReadBytes(sandbox.Path("room.mtl")), library);
  EXPECT_EQ(ReadBytes(sandbox.Path("p.csv")), points);
  // Devices may be written to more than once.
  EXPECT_EQ(sandbox.Run({"solve", "room.obj", "-o", "/dev/null", "--report", "/dev/null"}).status, 0);
}

// A file that nobody is permitted to write stays, whoever runs the program, and that is told before the
// solve; one that is replaced keeps its permissions.
TEST(Output, KeepsPermissions) {
  const Sandbox sandbox;
  sandbox.Write("kept.h5", "old");
  sandbox.Write("mine.h5", "old");
  namespace fs = std::filesystem;
  fs::permissions(sandbox.Path("kept.h5"), fs::perms::owner_read);
  fs::permissions(sandbox.Path("mine.h5"), fs::perms::owner_read | fs::perms::owner_write);
  const Outcome outcome = sandbox.Run({"solve", "office", "--error", "1e-6", "-o", "kept.h5"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("kept.h5: error: cannot write: Permission denied"));
  EXPECT_EQ(ReadBytes(sandbox.Path("kept.h5")), "old");
  EXPECT_EQ(sandbox.Run({"solve", "furnace", "--error", "0.5", "-o", "mine.h5"}).status, 0);
  EXPECT_EQ(fs::status(sandbox.Path("mine.h5")).permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_THAT(sandbox.Files(), ElementsAre("kept.h5", "mine.h5"));
}

// A limit to the size of files is an error like a full disk: one line, and nothing of the file is left.
TEST(Output, LimitOfFileSizeLeavesNothing) {
  const Sandbox sandbox;
  sandbox.Write("a.h5", "old");
  const Outcome outcome = sandbox.RunScript("ulimit -f 8; penumbra solve furnace --error 0.5 -o a.h5");
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_THAT(Lines(outcome.err), SizeIs(1)) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("a.h5: error: cannot write: File too large"));
  EXPECT_EQ(ReadBytes(sandbox.Path("a.h5")), "old");
  EXPECT_THAT(sandbox.Files(), ElementsAre("a.h5"));
}

// Streams that are closed or full are told by the status; nobody is killed, and files are written all the
// same.
TEST(Output, ClosedStreamsAreTold) {
  const Sandbox sandbox;
  for (const std::string script :
       {"penumbra scenes >&-", "penumbra scenes >/dev/full", "penumbra --help >/dev/full",
        "penumbra --version >&-", "penumbra info furnace >/dev/full",
        "penumbra solve furnace --error 0.5 >&-", "penumbra solve no-such-scene 2>&-",
        "penumbra view --help-script >/dev/full"})
    EXPECT_EQ(sandbox.RunScript(script).status, 1) << script;
  EXPECT_EQ(sandbox.RunScript("penumbra solve furnace --error 0.5 -o a.h5 >&- 2>&-").status, 0);
  EXPECT_EQ(sandbox.RunScript("penumbra solve furnace --error 0.5 -v -o b.h5 2>/dev/full").status, 1);
  EXPECT_EQ(ReadBytes(sandbox.Path("a.h5")), ReadBytes(sandbox.Path("b.h5")));
  EXPECT_EQ(sandbox.RunScript("penumbra solve --wrong 2>/dev/full").status, 2);
  // Who has read enough of a pipe is not told that there was more.
  const Outcome piped = sandbox.RunScript("penumbra solve furnace --error 0.5 --help | true");
  EXPECT_EQ(piped.err, "");
}

// Names may hold anything: a message is one line, which a terminal takes for text.
TEST(Output, MessagesAreOneLine) {
  const Sandbox sandbox;
  for (const std::string& name :
       {std::string("a\nb\x1b[31m\x07.obj"), std::string("\xff\xfe.obj"), std::string(3000, 'a')}) {
    const Outcome outcome = sandbox.Run({"info", name});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(Lines(outcome.err), SizeIs(1));
    EXPECT_LE(outcome.err.size(), 2001U);
    for (const char c : outcome.err.substr(0, outcome.err.size() - 1))
      EXPECT_GE(static_cast<unsigned char>(c), 0x20U);
  }
}

// The built-in scenes are sound: no command warns of anything.
TEST(Scenes, GiveNoWarnings) {
  const Sandbox sandbox;
  sandbox.Write("p.csv", "x,y,z,nx,ny,nz\n0.4,0.4,0.4,0,0,1\n");
  for (const std::string scene : {"office", "cornell", "floating-cube", "furnace", "blind", "building-1x1"})
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"info"},
             {"solve", "--error", "0.5", "-o", "a.h5"},
             {"probe", "--points", "p.csv", "--direct"},
             {"form-factor", "--from", "0", "--to", "1", "--method", "disk"},
             {"export", "-o", "a.mgf"},
             {"render", "--mode", "rho", "--size", "16x12", "-o", "a.png"}}) {
      std::vector<std::string> arguments = command;
      arguments.insert(arguments.begin() + 1, scene);
      const Outcome outcome = sandbox.Run(arguments);
      EXPECT_EQ(outcome.status, 0);
      EXPECT_EQ(outcome.err, "") << scene << " " << command[0];
    }
}

// An interrupt ends a solve with status 130 and writes nothing.
TEST(Interrupt, WritesNothing) {
  const Sandbox sandbox;
  const Outcome outcome = sandbox.RunAndSignal(
      {"render", "office", "--error", "1e-4", "-o", "image.png", "--report", "report.json", "-v"},
      "--error-points", SIGINT);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_THAT(sandbox.Files(), SizeIs(0));
}

}  // namespace
}  // namespace penumbra
