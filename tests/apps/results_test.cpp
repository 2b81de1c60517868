// What the commands compute, seen from outside.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "display/exr_image.h"
#include "tests/apps/run_program.h"

namespace penumbra {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::SizeIs;

constexpr const char* kProbeHeader =
    "x,y,z,nx,ny,nz,patch,exact_r,exact_g,exact_b,interp_r,interp_g,interp_b";

// A unit square at z = 0 that looks up, below one of emittance pi at z = 1 that looks down.
constexpr const char* kParallelSquares =
    "mtllib squares.mtl\n"
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "o floor\nusemtl grey\nf 1 2 3 4\no light\nusemtl light\nf 8 7 6 5\n";
constexpr const char* kSquaresMaterials =
    "newmtl grey\nKd 0.5 0.5 0.5\nnewmtl light\nKd 0 0 0\nKe 3.141592653589793 1 0\n";

// The form factor from a small area at the centre of the lower square to the upper one: four right-angled
// corners of half the side.
double CentreFormFactor() {
  const double a = 0.5 / std::sqrt(1.25);
  return 4 * (a * std::atan(a) * 2) / (2 * std::numbers::pi);
}

std::vector<double> Numbers(const std::string& line) {
  std::vector<double> numbers;
  for (const std::string& field : Fields(line)) numbers.push_back(std::strtod(field.c_str(), nullptr));
  return numbers;
}

// In the furnace irradiance is 1 W/m^2 everywhere: exactly by its sources, within the error by interpolants.
TEST(Probe, FurnaceIsOneEverywhere) {
  const Sandbox sandbox;
  sandbox.Write(
      "points.csv",
      "x,y,z,nx,ny,nz\n0.3,0.4,0,0,0,1\n0.9,0.1,1,0,0,-2\n0,0.5,0.25,1e-3,0,0\n0.5,0.5,0.5,1,2,3\n");
  const Outcome probe = sandbox.Run({"probe", "furnace", "--points", "points.csv", "--error", "0.1"});
  ASSERT_EQ(probe.status, 0) << probe.err;
  EXPECT_EQ(probe.err, "");
  const std::vector<std::string> lines = Lines(probe.out);
  ASSERT_THAT(lines, SizeIs(5));
  EXPECT_EQ(lines[0], kProbeHeader);
  const std::vector<int> faces = {0, 1, 2, -1};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::vector<double> row = Numbers(lines[i + 1]);
    ASSERT_THAT(row, SizeIs(13));
    EXPECT_EQ(row[6], faces[i]);
    for (std::size_t c = 7; c < 10; ++c) EXPECT_NEAR(row[c], 1, 0.05);
    for (std::size_t c = 10; c < 13; ++c)
      if (faces[i] >= 0)
        EXPECT_NEAR(row[c], 1, 0.05);
      else
        EXPECT_EQ(Fields(lines[i + 1])[c], "nan");
  }
}

// Direct light is the closed form's, needs no solve, comes in the order of the points, and has all digits;
// points where no light can be expected are named in one warning.
TEST(Probe, DirectLightOfParallelSquares) {
  const Sandbox sandbox;
  sandbox.Write("squares.obj", kParallelSquares);
  sandbox.Write("squares.mtl", kSquaresMaterials);
  sandbox.Write("points.csv",
                "\xef\xbb\xbfx, y, z, nx, ny, nz\r\n0.5,0.5,0,0,0,3\r\n\r\n0.5,0.5,0,0,0,0\r\n"
                "0.5,0.5,-1,0,0,1\r\n0.5,0.5,0,0,0,-1\r\n0.1,0.5,0,0,0.01,1");
  const Outcome probe =
      sandbox.Run({"probe", "squares.obj", "--points", "points.csv", "--direct", "-o", "out.csv"});
  ASSERT_EQ(probe.status, 0) << probe.err;
  EXPECT_EQ(probe.out, "");
  const std::vector<std::string> lines = Lines(ReadBytes(sandbox.Path("out.csv")));
  ASSERT_THAT(lines, SizeIs(6));
  EXPECT_EQ(lines[0], kProbeHeader);

  const std::vector<double> centre = Numbers(lines[1]);
  EXPECT_EQ(centre[6], 0);
  EXPECT_NEAR(centre[7], std::numbers::pi * CentreFormFactor(), 1e-14);
  EXPECT_NEAR(centre[8], CentreFormFactor(), 1e-15);
  EXPECT_EQ(centre[9], 0);
  EXPECT_THAT(lines[1], HasSubstr(",nan,nan,nan"));

  EXPECT_EQ(lines[2], "0.5,0.5,0,0,0,0,-1,nan,nan,nan,nan,nan,nan");
  EXPECT_EQ(lines[3].substr(0, 18), "0.5,0.5,-1,0,0,1,-");
  EXPECT_EQ(lines[4], "0.5,0.5,0,0,0,-1,-1,0,0,0,nan,nan,nan");
  EXPECT_THAT(lines[5], testing::StartsWith("0.10000000000000001,0.5,0,0,0.01,1,0,0."));

  ASSERT_THAT(Lines(probe.err), SizeIs(1)) << probe.err;
  EXPECT_THAT(probe.err, HasSubstr("warning: "));
  EXPECT_THAT(probe.err, HasSubstr("behind faces: rows 3, 4"));
  EXPECT_THAT(probe.err, HasSubstr("zero normal: row 2"));
}

// The parts of the light: direct light is all of it where nothing is solved, and the gradient on the axis of
// a square light is steepest towards it; a zero normal has none.
TEST(Probe, PartsOfParallelSquares) {
  const Sandbox sandbox;
  sandbox.Write("squares.obj", kParallelSquares);
  sandbox.Write("squares.mtl", kSquaresMaterials);
  sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n0.5,0.5,0,0,0,1\n0.5,0.5,0,0,0,0\n");
  const Outcome probe =
      sandbox.Run({"probe", "squares.obj", "--points", "points.csv", "--direct", "--parts"});
  ASSERT_EQ(probe.status, 0) << probe.err;
  const std::vector<std::string> lines = Lines(probe.out);
  ASSERT_THAT(lines, SizeIs(3));
  EXPECT_EQ(lines[0], std::string(kProbeHeader) +
                          ",direct_r,direct_g,direct_b,grad_r_x,grad_r_y,grad_r_z,grad_g_x,grad_g_y,grad_g_z,"
                          "grad_b_x,grad_b_y,grad_b_z");
  const std::vector<double> row = Numbers(lines[1]);
  ASSERT_THAT(row, SizeIs(25));
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(row[13 + c], row[7 + c], 1e-15);
  // F = 2 a / (pi c) atan(a / c) x 2, c^2 = h^2 + a^2, rises as h falls: the derivative by h, negated.
  const double c = std::sqrt(1.25), a = 0.5;
  const double rise = 4 * a / std::numbers::pi * (std::atan(a / c) / (c * c) + a / (c * (c * c + a * a))) / c;
  EXPECT_NEAR(row[16], 0, 1e-15);
  EXPECT_NEAR(row[17], 0, 1e-15);
  EXPECT_NEAR(row[18], std::numbers::pi * rise, 1e-14);
  EXPECT_NEAR(row[21], rise, 1e-14);
  EXPECT_THAT(lines[2], HasSubstr(",nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan"));
}

// All exact methods print the same light to 12 digits in a furnished room, and samples nearly so.
TEST(Probe, MethodsAgree) {
  const Sandbox sandbox;
  std::string points = "x,y,z,nx,ny,nz\n";
  for (int i = 0; i < 40; ++i) points += std::to_string(0.3 + 0.07 * i) + ",1.1,0.02,0.1,0.2,1\n";
  sandbox.Write("points.csv", points);
  const auto values = [&](const char* method) {
    const Outcome probe =
        sandbox.Run({"probe", "office", "--points", "points.csv", "--direct", "--method", method});
    EXPECT_EQ(probe.status, 0) << probe.err;
    std::vector<double> red;
    for (const std::string& line : Lines(probe.out)) red.push_back(Numbers(line)[7]);
    return red;
  };
  const std::vector<double> automatic = values("auto");
  ASSERT_THAT(automatic, SizeIs(41));
  for (const char* method : {"clipping", "backprojection", "vertex-tracing", "sampled"}) {
    const std::vector<double> other = values(method);
    const double allowed = method == std::string("sampled") ? 0.2 : 1e-12;
    for (std::size_t i = 1; i < automatic.size(); ++i)
      EXPECT_NEAR(other[i], automatic[i], allowed * automatic[i]) << method << ", row " << i;
  }
  const Outcome unknown =
      sandbox.Run({"probe", "office", "--points", "points.csv", "--direct", "--method", "guess"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("--method"));
}

// A point inside furniture that stands without a bottom on an uncut floor is named, one beside it is not.
TEST(Probe, NamesPointsInsideFurniture) {
  const Sandbox sandbox;
  sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n0.5,0.5,0.1,0,0,1\n0.2,0.2,0,0,0,1\n0.5,0.5,0,0,0,1\n");
  sandbox.Write("box.obj",
                "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
                "v 0.4 0.4 0\nv 0.6 0.4 0\nv 0.6 0.6 0\nv 0.4 0.6 0\n"
                "v 0.4 0.4 0.2\nv 0.6 0.4 0.2\nv 0.6 0.6 0.2\nv 0.4 0.6 0.2\n"
                "f 9 10 11 12\nf 5 6 10 9\nf 6 7 11 10\nf 7 8 12 11\nf 8 5 9 12\n");
  const Outcome probe = sandbox.Run({"probe", "box.obj", "--points", "points.csv", "--direct"});
  ASSERT_EQ(probe.status, 0) << probe.err;
  EXPECT_THAT(probe.err, HasSubstr("inside a solid or behind faces: rows 1, 3\n"));
}

// The same input gives the same bytes, on every run and for every number of threads.
TEST(Determinism, SameBytesForAnyThreads) {
  const Sandbox sandbox;
  std::string points = "x,y,z,nx,ny,nz\n";
  for (int i = 0; i < 100; ++i) points += std::to_string(0.02 * i - 1) + ",0.1,0.3,0.2,0.1,1\n";
  sandbox.Write("points.csv", points);
  std::vector<std::string> csv, png, exr;
  for (const char* threads : {"1", "2", "2"}) {
    const Outcome probe = sandbox.Run(
        {"probe", "floating-cube", "--points", "points.csv", "--error", "0.5", "--threads", threads});
    ASSERT_EQ(probe.status, 0) << probe.err;
    csv.push_back(probe.out);
    for (const char* image : {"image.png", "image.exr"}) {
      const Outcome render = sandbox.Run({"render", "floating-cube", "-o", image, "--size", "64x48",
                                          "--error", "0.5", "--threads", threads});
      ASSERT_EQ(render.status, 0) << render.err;
    }
    png.push_back(ReadBytes(sandbox.Path("image.png")));
    exr.push_back(ReadBytes(sandbox.Path("image.exr")));
  }
  for (const auto* results : {&csv, &png, &exr}) {
    EXPECT_FALSE(results->front().empty());
    EXPECT_EQ((*results)[0], (*results)[1]) << "one thread and two";
    EXPECT_EQ((*results)[1], (*results)[2]) << "two runs";
  }
}

// Times, the number of threads and memory apart, reports are the same for every number of threads.
TEST(Determinism, SameReportForAnyThreads) {
  const Sandbox sandbox;
  std::vector<json> reports;
  for (const char* threads : {"1", "2"}) {
    const Outcome solve = sandbox.Run({"solve", "floating-cube", "--error", "0.3", "--error-points", "100",
                                       "--report", "report.json", "--threads", threads});
    ASSERT_EQ(solve.status, 0) << solve.err;
    json report = json::parse(ReadBytes(sandbox.Path("report.json")));
    for (const char* key : {"phases", "threads", "memory_peak_bytes"}) report.erase(key);
    report.at("options").erase("threads");
    for (json& iteration : report.at("iterations")) iteration.erase("seconds");
    reports.push_back(report);
  }
  EXPECT_EQ(reports[0], reports[1]);
}

// The report holds every field, and adds up; -v tells the options used.
TEST(Solve, ReportHoldsEveryField) {
  const Sandbox sandbox;
  const Outcome solve = sandbox.Run(
      {"solve", "furnace", "--error", "0.1", "--report", "report.json", "--error-points", "50", "-v"});
  ASSERT_EQ(solve.status, 0) << solve.err;
  EXPECT_EQ(solve.out, "");
  EXPECT_THAT(solve.err, HasSubstr("Options used:\n"));
  EXPECT_THAT(solve.err, HasSubstr("   --error 0.1\n"));
  EXPECT_THAT(sandbox.Files(), testing::ElementsAre("report.json"));

  const json report = json::parse(ReadBytes(sandbox.Path("report.json")));
  EXPECT_TRUE(report.at("version").is_string());
  EXPECT_GE(report.at("threads").get<int>(), 1);
  EXPECT_EQ(report.at("options").at("error"), 0.1);
  EXPECT_GT(report.at("options").at("eps"), 0);
  std::vector<std::string> phases;
  for (const json& phase : report.at("phases")) {
    phases.push_back(phase.at("name"));
    EXPECT_GE(phase.at("seconds"), 0);
  }
  EXPECT_THAT(phases, testing::IsSupersetOf(
                          {"load", "link", "iterate", "discontinuities", "triangulate", "interpolate"}));
  for (const char* count :
       {"patches", "emitters", "elements", "leaves", "links", "links_visible", "links_partial",
        "discontinuities", "dsets_active", "triangles", "interpolants", "point_evaluations"})
    EXPECT_TRUE(report.at("counts").at(count).is_number_unsigned()) << count;
  EXPECT_EQ(report.at("counts").at("patches"), 6);
  EXPECT_EQ(report.at("counts").at("emitters"), 6);
  ASSERT_FALSE(report.at("iterations").empty());
  for (const char* field : {"residual", "elements", "links", "seconds"})
    EXPECT_TRUE(report.at("iterations")[0].at(field).is_number()) << field;
  // Squares in halves.
  EXPECT_NEAR(report.at("diagnostics").at("triangles").at("smallest_angle").get<double>(), 45, 1e-9);
  const json& energy = report.at("energy");
  EXPECT_NEAR(energy.at("emitted").get<double>(), 9, 1e-9);  // 6 m^2, 1/2 W/m^2, three channels
  EXPECT_NEAR(energy.at("absorbed").get<double>() + energy.at("escaped").get<double>(), 9, 9e-2);
  EXPECT_LT(energy.at("relative_imbalance"), 1e-2);
  const json& error = report.at("error");
  EXPECT_EQ(error.at("interpolant").at("points"), 50);
  for (const char* field : {"max", "p99", "p95", "rms"}) EXPECT_GE(error.at("interpolant").at(field), 0);
  EXPECT_TRUE(error.at("solution").at("estimate").is_number());
  EXPECT_EQ(error.at("asked"), 0.1);
  EXPECT_EQ(error.at("met"), true);
  EXPECT_GT(report.at("memory_peak_bytes"), 1000000);
  EXPECT_TRUE(report.at("unmet").is_array());
}

// A point's exact irradiance comes from the light that the dense solver found, whatever the mesh that is
// shown is refined by.
TEST(Solve, DenseLightIsTheReference) {
  const Sandbox sandbox;
  sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n0.11,0.21,0,0,0,1\n0.3,0.4,0.2,0,1,0\n");
  const auto exact = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments = {"probe", "floating-cube", "--points", "points.csv", "--solver",
                                          "dense", "--divisions",   "2",        "--error",    "0.1"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome probe = sandbox.Run(arguments);
    EXPECT_EQ(probe.status, 0) << probe.err;
    std::vector<std::vector<std::string>> rows;
    const std::vector<std::string> lines = Lines(probe.out);
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const std::vector<std::string> fields = Fields(lines[i]);
      rows.emplace_back(fields.begin() + 7, fields.begin() + 10);
    }
    EXPECT_EQ(rows.size(), 2U);
    return rows;
  };
  EXPECT_EQ(exact({}), exact({"--min-discontinuity-weight", "100"}));
}

// The dense solver finds the furnace's irradiance with every basis, and reports how well its matrix closes.
TEST(Solve, DenseFurnace) {
  const Sandbox sandbox;
  sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n0.5,0.25,0,0,0,1\n0.3,0.6,0.4,1,0,0\n");
  for (const std::string basis : {"constant", "linear", "quadratic"}) {
    const Outcome probe = sandbox.Run({"probe", "furnace", "--points", "points.csv", "--solver", "dense",
                                       "--basis", basis, "--divisions", "2", "--report", "report.json"});
    ASSERT_EQ(probe.status, 0) << probe.err;
    const json dense = json::parse(ReadBytes(sandbox.Path("report.json"))).at("dense");
    EXPECT_EQ(dense.at("unknowns"), basis == "constant" ? 24 : basis == "linear" ? 96 : 216);
    EXPECT_NEAR(dense.at("least_row_sum").get<double>(), 1, 1e-11);
    EXPECT_NEAR(dense.at("largest_row_sum").get<double>(), 1, 1e-11);
    EXPECT_LE(dense.at("form_factor_error").get<double>(), 1e-11);
    EXPECT_THAT(probe.out, HasSubstr(kProbeHeader));
    const std::string rows = probe.out.substr(probe.out.find('\n') + 1);
    for (std::size_t begin = 0; begin < rows.size();) {
      const std::size_t end = rows.find('\n', begin);
      EXPECT_NEAR(Numbers(rows.substr(begin, end - begin)).at(7), 1, 1e-10) << basis;
      begin = end + 1;
    }
  }
  EXPECT_EQ(sandbox.Run({"solve", "furnace", "--solver", "dense", "--divisions", "3"}).status, 2);
  EXPECT_EQ(sandbox.Run({"solve", "furnace", "--solver", "dense", "--divisions", "64"}).status, 1);
}

// Without a report file, solve prints the phases and the error.
TEST(Solve, PrintsATable) {
  const Outcome solve = Sandbox().Run({"solve", "furnace", "--error", "0.1", "--error-points", "10"});
  ASSERT_EQ(solve.status, 0) << solve.err;
  for (const char* word :
       {"load", "link", "iterate", "discontinuities", "triangulate", "interpolate", "p99", "asked"})
    EXPECT_THAT(solve.out, HasSubstr(word));
}

// A scene left without faces is valid, and dark.
TEST(Solve, EmptySceneIsDark) {
  const Sandbox sandbox;
  sandbox.Write("empty.obj", "v 0 0 0\n");
  sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n0,0,0,0,0,1\n");
  EXPECT_EQ(sandbox.Run({"info", "empty.obj"}).status, 0);
  EXPECT_EQ(sandbox.Run({"solve", "empty.obj", "--report", "report.json"}).status, 0);
  const Outcome render = sandbox.Run({"render", "empty.obj", "-o", "image.exr", "--size", "8x8"});
  EXPECT_EQ(render.status, 0) << render.err;
  for (const auto& channel : ReadExr(sandbox.Path("image.exr")).channel)
    EXPECT_THAT(channel, testing::Each(0.0f));
  const Outcome probe = sandbox.Run({"probe", "empty.obj", "--points", "points.csv"});
  EXPECT_EQ(probe.status, 0) << probe.err;
  EXPECT_THAT(probe.out, HasSubstr("\n0,0,0,0,0,1,-1,0,0,0,nan,nan,nan\n"));
}

// Every mode draws the furnace: its radiosity is 1 W/m^2, its reflectance 1/2, wherever one looks. The
// constants of flat, and their means, carry the error of single elements, which the exact samples of the
// other modes do not show.
TEST(Render, EveryModeDrawsTheFurnace) {
  const Sandbox sandbox;
  for (const char* mode : {"flat", "gouraud", "gouraud-mesh", "interpolant", "exact", "lerp", "rho", "nodal",
                           "gouraud-screen", "bilinear", "bicubic"}) {
    const Outcome render =
        sandbox.Run({"render", "furnace", "-o", "image.exr", "--mode", mode, "--size", "32x24", "--error",
                     "0.1", "--eye", "0.5,0.1,0.5", "--look-at", "0.5,1,0.5", "--fov", "60"});
    ASSERT_EQ(render.status, 0) << render.err;
    const RgbImage image = ReadExr(sandbox.Path("image.exr"));
    ASSERT_EQ(image.width, 32);
    ASSERT_EQ(image.height, 24);
    const float want = std::string(mode) == "rho" ? 0.5f : 1.0f;
    const bool by_means = std::set<std::string>{"flat", "nodal", "gouraud-screen"}.contains(mode);
    const float tolerance = by_means ? 0.2f : 0.05f;
    for (const auto& channel : image.channel)
      for (const float value : channel) ASSERT_NEAR(value, want, tolerance) << mode;
  }
}

// A path is a picture for each camera, numbered, the same as without a path; wrong lines are refused before
// the work.
TEST(Render, FollowsAPath) {
  const Sandbox sandbox;
  sandbox.Write("walk.txt", "# two steps\n0.5,0.1,0.5 0.5,1,0.5\n\n  0.2,0.2,0.5  0.5,1,0.5\t0,1,0.5 70\r\n");
  const std::vector<std::string> picture = {"render", "floating-cube", "--mode",  "flat",
                                            "--size", "16x12",         "--error", "0.5"};
  const Outcome walk = sandbox.Run(With(picture, {"--path", "walk.txt", "-o", "walk.exr", "--fov", "50"}));
  ASSERT_EQ(walk.status, 0) << walk.err;
  EXPECT_EQ(sandbox.Files(), (std::vector<std::string>{"walk-0000.exr", "walk-0001.exr", "walk.txt"}));
  ASSERT_EQ(sandbox
                .Run(With(picture,
                          {"-o", "a.exr", "--eye", "0.5,0.1,0.5", "--look-at", "0.5,1,0.5", "--fov", "50"}))
                .status,
            0);
  ASSERT_EQ(sandbox
                .Run(With(picture, {"-o", "b.exr", "--eye", "0.2,0.2,0.5", "--look-at", "0.5,1,0.5", "--up",
                                    "0,1,0.5", "--fov", "70"}))
                .status,
            0);
  EXPECT_EQ(ReadBytes(sandbox.Path("walk-0000.exr")), ReadBytes(sandbox.Path("a.exr")));
  EXPECT_EQ(ReadBytes(sandbox.Path("walk-0001.exr")), ReadBytes(sandbox.Path("b.exr")));
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"0,0,1 1,0,1\n0,0,1\n", "c.txt:2: error: a line is EYE LOOK-AT"},
           {"0,0,1 1,0\n", "c.txt:1: error: '1,0' is not three numbers"},
           {"0,0,1 0,0,1\n", "eye and look-at are the same point"},
           {"0,0,1 1,0,1 2,0,0\n", "the up direction is parallel to the view"},
           {"0,0,1 1,0,1 0,0,1 200\n", "a field of view of 200 degrees"},
           {"# nothing\n", "c.txt: error: it has no camera"}}) {
    sandbox.Write("c.txt", text);
    const Outcome wrong = sandbox.Run(With(picture, {"--path", "c.txt", "-o", "c.png"}));
    EXPECT_EQ(wrong.status, 1) << text;
    EXPECT_THAT(wrong.err, HasSubstr(message));
  }
  EXPECT_EQ(sandbox.Run(With(picture, {"--path", "walk.txt"})).status, 2);
  EXPECT_EQ(sandbox.Run(With(picture, {"--path", "walk.txt", "-o", "d.png", "--eye", "0,0,1"})).status, 2);
  EXPECT_EQ(sandbox.Run(With(picture, {"--path", "walk.txt", "--benchmark", "2", "-o", "d.png"})).status, 2);
  EXPECT_EQ(sandbox.Files().size(), 6U) << "nothing was written for what was refused";
}

// RayShade shows what a probe measures: radiosity is exact irradiance x reflectance at the point that a
// pixel's ray meets.
TEST(Render, ExactShowsWhatAProbeMeasures) {
  const Sandbox sandbox;
  // A square floor, lit by a square light above it, half hidden by a screen; seen from above the light.
  sandbox.Write("shade.mtl", "newmtl grey\nKd 0.5 0.4 0.3\nKe 0 0 0\nnewmtl light\nKd 0 0 0\nKe 9 8 7\n");
  sandbox.Write("shade.obj",
                "mtllib shade.mtl\nv -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nv -1 -1 2\nv -1 1 2\nv 1 1 2\n"
                "v 1 -1 2\nv -1 -1 1\nv -1 0 1\nv 1 0 1\nv 1 -1 1\n"
                "usemtl grey\nf 1 2 3 4\nf 9 10 11 12\nusemtl light\nf 5 6 7 8\n");
  const std::vector<std::string> picture = {"render", "shade.obj", "-o",    "image.exr", "--mode",    "exact",
                                            "--size", "8x8",       "--eye", "0,0,4",     "--look-at", "0,0,0",
                                            "--up",   "0,1,0",     "--fov", "40",        "--error",   "0.3"};
  const Outcome render = sandbox.Run(picture);
  ASSERT_EQ(render.status, 0) << render.err;
  const RgbImage image = ReadExr(sandbox.Path("image.exr"));
  ASSERT_EQ(image.width, 8);

  std::string points = "x,y,z,nx,ny,nz\n";
  const double pixel = 2 * 4 * std::tan(20 * std::numbers::pi / 180) / 8;  // [m] on the floor
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      points += std::to_string((x - 3.5) * pixel) + "," + std::to_string((3.5 - y) * pixel) + ",0,0,0,1\n";
  sandbox.Write("points.csv", points);
  const Outcome probe = sandbox.Run({"probe", "shade.obj", "--points", "points.csv", "--error", "0.3"});
  ASSERT_EQ(probe.status, 0) << probe.err;
  const std::vector<std::string> rows = Lines(probe.out);
  ASSERT_THAT(rows, SizeIs(65));
  const std::array<double, 3> reflectance = {0.5, 0.4, 0.3};
  for (std::size_t i = 0; i < 64; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double want = reflectance[c] * std::stod(Fields(rows[i + 1])[7 + c]);
      EXPECT_GT(want, 0.001);
      // Points are given with six decimals, and light varies by some of itself a metre.
      EXPECT_NEAR(static_cast<double>(image.channel[c][i]), want, 1e-5 * want) << i;
    }
}

// A benchmark prints one line of JSON with the times of a frame.
TEST(Render, BenchmarkPrintsOneLine) {
  const Sandbox sandbox;
  const Outcome outcome = sandbox.Run(
      {"render", "furnace", "--benchmark", "3", "--size", "64x48", "--error", "0.5", "--threads", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  ASSERT_THAT(Lines(outcome.out), SizeIs(1));
  const json line = json::parse(outcome.out);
  EXPECT_GT(line.at("fps"), 0);
  for (const char* part : {"triangle_ids", "barycentric", "evaluate", "tone_map", "total"})
    EXPECT_GE(line.at("ms").at(part), 0);
  EXPECT_EQ(line.at("size"), "64x48");
  EXPECT_GE(line.at("triangles"), 12);
  EXPECT_EQ(line.at("threads"), 1);
  EXPECT_THAT(sandbox.Files(), SizeIs(0));
}

// A benchmark by the graphics system, where there is one, draws the same triangles; where there is none, that
// is told in one line, before any work.
TEST(Render, BackEndsAreAChoice) {
  const Sandbox sandbox;
  const std::vector<std::string> picture = {"render", "furnace", "-o",      "image.exr",
                                            "--size", "32x24",   "--error", "0.5"};
  ASSERT_EQ(sandbox.Run(picture).status, 0);
  const RgbImage software = ReadExr(sandbox.Path("image.exr"));
  std::vector<std::string> by_opengl = picture;
  by_opengl.insert(by_opengl.end(), {"--backend", "opengl"});
  const Outcome opengl = sandbox.Run(by_opengl);
  if (opengl.status == 0) {
    const RgbImage image = ReadExr(sandbox.Path("image.exr"));
    for (std::size_t i = 0; i < image.PixelCount(); ++i)
      EXPECT_NEAR(image.channel[0][i], software.channel[0][i], 1e-3 * software.channel[0][i]) << i;
  } else {
    EXPECT_THAT(opengl.err, HasSubstr("--backend software"));
  }
  std::filesystem::remove(sandbox.Path("image.exr"));
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere.json", 1);  // hides every driver from EGL
  const Outcome none = sandbox.Run(by_opengl);
  unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
  EXPECT_EQ(none.status, 1);
  EXPECT_THAT(Lines(none.err), SizeIs(1)) << none.err;
  EXPECT_THAT(sandbox.Files(), SizeIs(0));
}

// False colours and scratch images are pictures of the size asked for, and differ from the plain one.
TEST(Render, ShowsFalseColoursAndScratchImages) {
  const Sandbox sandbox;
  std::set<std::string> pictures;
  for (const std::vector<std::string>& more : {std::vector<std::string>{},
                                               {"--false-colour"},
                                               {"--false-colour", "--scale-max", "5"},
                                               {"--split"}}) {
    std::vector<std::string> command = {"render", "floating-cube", "-o",   "image.png", "--size",
                                        "161x93", "--mode",        "flat", "--error",   "0.5"};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome outcome = sandbox.Run(command);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    pictures.insert(ReadBytes(sandbox.Path("image.png")));
  }
  EXPECT_THAT(pictures, SizeIs(4));
}

// Info tells what is in a scene: counts, bounds, area and emitted power; emission may be read as radiance.
TEST(Info, CountsAndMeasures) {
  const Sandbox sandbox;
  sandbox.Write("squares.obj", kParallelSquares);
  sandbox.Write("squares.mtl", kSquaresMaterials);
  const Outcome outcome = sandbox.Run({"info", "squares.obj", "--json", "--error", "0.1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json info = json::parse(outcome.out);
  EXPECT_EQ(info.at("faces"), 2);
  EXPECT_EQ(info.at("dropped"), 0);
  EXPECT_EQ(info.at("patches"), 2);
  EXPECT_EQ(info.at("quadrilaterals"), 2);
  EXPECT_EQ(info.at("emitters"), 1);
  EXPECT_EQ(info.at("bounds").at("max"), json({1.0, 1.0, 1.0}));
  EXPECT_EQ(info.at("area"), 2.0);
  EXPECT_EQ(info.at("emitted_power"), json({std::numbers::pi, 1.0, 0.0}));

  const json radiance =
      json::parse(sandbox.Run({"info", "squares.obj", "--json", "--emission-is-radiance"}).out);
  EXPECT_NEAR(radiance.at("emitted_power")[1].get<double>(), std::numbers::pi, 1e-15);
  const json two_sided = json::parse(sandbox.Run({"info", "squares.obj", "--json", "--two-sided"}).out);
  EXPECT_EQ(two_sided.at("faces"), 4);
}

// --faces lists the corners of each face as the file has them, as text and as JSON.
TEST(Info, ListsFaces) {
  const Sandbox sandbox;
  sandbox.Write("squares.obj", kParallelSquares);
  sandbox.Write("squares.mtl", kSquaresMaterials);
  const json plain = json::parse(sandbox.Run({"info", "squares.obj", "--json"}).out);
  EXPECT_FALSE(plain.at("face_list")[0].contains("corners"));
  const Outcome text = sandbox.Run({"info", "squares.obj", "--faces"});
  ASSERT_EQ(text.status, 0) << text.err;
  const json faces =
      json::parse(sandbox.Run({"info", "squares.obj", "--faces", "--json"}).out).at("face_list");
  ASSERT_THAT(faces, SizeIs(2));
  for (const json& face : faces) {
    EXPECT_EQ(face.at("area"), 1.0);
    ASSERT_THAT(face.at("corners"), SizeIs(4));
    EXPECT_EQ(face.at("centroid"), json({0.5, 0.5, face.at("corners")[0][2]}));
  }
  EXPECT_NE(faces[0].at("corners")[0][2], faces[1].at("corners")[0][2]);
  for (const char* part :
       {"face 1: object light", "centroid 0.5,0.5,0 m", "centroid 0.5,0.5,1 m", "corner 0,1,1 m"})
    EXPECT_THAT(text.out, HasSubstr(part));
}

// F and its error, as form-factor prints them.
std::pair<double, double> FormFactorOf(const Sandbox& sandbox, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "form-factor");
  const Outcome outcome = sandbox.Run(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(Lines(outcome.out), SizeIs(1));
  double factor = -1, error = -1;
  EXPECT_EQ(std::sscanf(outcome.out.c_str(), "%lg %lg", &factor, &error), 2) << outcome.out;
  return {factor, error};
}

// Opposite faces of a unit cube have the closed form's form factor, by name and by number, either way, and by
// every method within what it says of itself.
TEST(FormFactor, OfParallelSquares) {
  const Sandbox sandbox;
  sandbox.Write("squares.obj", kParallelSquares);
  sandbox.Write("squares.mtl", kSquaresMaterials);
  constexpr double kParallel = 0.19982489569838738;
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"floor", "light"}, {"light", "floor"}, {"0", "1"}, {"floor", "1"}}) {
    const auto [factor, error] = FormFactorOf(sandbox, {"squares.obj", "--from", from, "--to", to});
    EXPECT_NEAR(factor, kParallel, error);
    EXPECT_LE(error, 1e-12);
  }
  const auto with = [&](const char* method) {
    return FormFactorOf(sandbox, {"squares.obj", "--from", "0", "--to", "1", "--method", method});
  };
  const auto cubature = with("cubature"), random = with("monte-carlo"), disk = with("disk");
  EXPECT_NEAR(cubature.first, kParallel, cubature.second);
  EXPECT_NEAR(random.first, kParallel, 5 * random.second);
  EXPECT_NEAR(disk.first, 1 / (std::numbers::pi + 1), 1e-12);  // of a disk of area 1, at distance 1
}

// What leaves a face of a closed scene arrives in it: the factors to all objects add up to 1; and the bytes
// are the same for any number of threads.
TEST(FormFactor, AllArrives) {
  const Sandbox sandbox;
  double sum = 0, errors = 0;
  for (const char* to : {"0", "1", "2", "3", "4", "5"}) {
    const auto [factor, error] = FormFactorOf(sandbox, {"furnace", "--from", "box", "--to", to});
    sum += factor;
    errors += error;
  }
  EXPECT_NEAR(sum, 1, errors);
  const std::vector<std::string> pair = {"form-factor", "cornell",     "--from", "tall_block", "--to",
                                         "left_wall",   "--tolerance", "1e-5",   "--threads"};
  std::vector<std::string> one = pair, three = pair;
  one.push_back("1");
  three.push_back("3");
  const Outcome alone = sandbox.Run(one);
  EXPECT_EQ(alone.status, 0) << alone.err;
  EXPECT_EQ(alone.out, sandbox.Run(three).out);
}

// A blocker half way takes away what it hides; a gap in the numbers that a concave face leaves does not show.
TEST(FormFactor, PastABlocker) {
  const Sandbox sandbox;
  sandbox.Write("blocked.obj",
                "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                "v .25 .25 .5\nv .75 .25 .5\nv .75 .75 .5\nv .25 .75 .5\n"
                "o floor\nf 1 2 3\nf 1 3 4\no light\nf 8 7 6 5\ng blocker\nf 9 10 11 12\n");
  constexpr double kBlocked = 0.09950629459898478629799709;
  const auto [factor, error] = FormFactorOf(sandbox, {"blocked.obj", "--from", "floor", "--to", "light"});
  EXPECT_NEAR(factor, kBlocked, error);
  EXPECT_LE(error, 1e-6 * kBlocked);
  for (const char* method : {"auto", "exact", "clipping", "backprojection", "vertex-tracing"}) {
    const auto [same, off] =
        FormFactorOf(sandbox, {"blocked.obj", "--from", "floor", "--to", "light", "--method", method});
    EXPECT_NEAR(same, kBlocked, off) << method;
    EXPECT_LE(off, 1e-6 * kBlocked) << method;
  }
  const auto first = FormFactorOf(sandbox, {"blocked.obj", "--from", "0", "--to", "light"}),
             second = FormFactorOf(sandbox, {"blocked.obj", "--from", "1", "--to", "2"});
  EXPECT_NEAR(0.5 * (first.first + second.first), kBlocked, 0.5 * (first.second + second.second));
}

// Names and numbers that are not there are told in a line, with exit status 1.
TEST(FormFactor, NamesWhatIsMissing) {
  const Sandbox sandbox;
  for (const auto& [name, told] :
       std::vector<std::pair<std::string, std::string>>{{"sofa", "no object or group `sofa`"},
                                                        {"6", "0 to 5"},
                                                        {"-1", "`-1`"},
                                                        {"1x", "`1x`"},
                                                        {"99999999999999999999999", "0 to 5"}}) {
    const Outcome outcome = sandbox.Run({"form-factor", "furnace", "--from=" + name, "--to", "0"});
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(Lines(outcome.err), SizeIs(1));
    EXPECT_THAT(outcome.err, HasSubstr(told));
  }
}

// Steps, schemes, oracles, limits, bounces and changed materials, as a user asks for them: the report tells
// them.
TEST(Solve, OptionsOfTheSolver) {
  const Sandbox sandbox;
  const auto solve = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"solve",          "furnace", "--error",  "0.2",
                                          "--error-points", "0",       "--report", "report.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = sandbox.Run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json::parse(ReadBytes(sandbox.Path("report.json")));
  };
  const json one = solve({"--iterations", "1"});
  EXPECT_FALSE(one["error"]["met"].get<bool>());  // nobody measured it
  EXPECT_EQ(one["iterations"].size(), 1U);
  EXPECT_GT(one["iterations"][0]["residual"].get<double>(), 0);
  ASSERT_GE(one["unmet"].size(), 1U);
  EXPECT_THAT(one["unmet"][0].get<std::string>(), HasSubstr("1 iterations"));

  // In the furnace every bounce brings half of the last one.
  const json bounces =
      solve({"--bounces", "3", "--scheme", "gauss-seidel", "--oracle", "gradient", "--multigrid"});
  ASSERT_EQ(bounces["diagnostics"]["bounces"].size(), 3U);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(bounces["diagnostics"]["bounces"][k][0].get<double>(), std::pow(0.5, k + 1), 0.01);
  EXPECT_EQ(bounces["options"]["oracle"], "gradient");
  EXPECT_EQ(bounces["options"]["scheme"], "gauss-seidel");
  EXPECT_GT(bounces["iterations"][0]["eps"].get<double>(), bounces["options"]["eps"].get<double>());
  EXPECT_NEAR(bounces["diagnostics"]["closure"]["mean"].get<double>(), 1, 0.01);
  EXPECT_EQ(bounces["diagnostics"]["open"]["escaping"].get<double>(), 0);

  const json thesis = solve({"--min-backprojection-segment", "1e-6", "--nudge", "1e-9"});
  EXPECT_EQ(thesis["options"]["min_backprojection_segment"].get<double>(), 1e-6);

  const json limited = solve({"--time-limit", "1e-9"});
  ASSERT_GE(limited["unmet"].size(), 1U);
  EXPECT_THAT(limited["unmet"][0].get<std::string>(), HasSubstr("time limit"));
  EXPECT_EQ(limited["iterations"].size(), 0U);

  EXPECT_EQ(sandbox.Run({"solve", "furnace", "--emittance", "no such thing=1,1,1"}).status, 2);
  EXPECT_EQ(sandbox.Run({"solve", "furnace", "--emittance", "glow=-1,1,1"}).status, 2);
  EXPECT_EQ(sandbox.Run({"solve", "furnace", "--reflectance", "glow=1,0,0"}).status, 2);
  EXPECT_EQ(sandbox.Run({"solve", "furnace", "--oracle", "delphi"}).status, 2);
}

// Other materials on the command line are those that the light is worked out with.
TEST(Solve, ChangedMaterials) {
  const Sandbox sandbox;
  sandbox.Write("squares.obj", kParallelSquares);
  sandbox.Write("squares.mtl", kSquaresMaterials);
  sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n0.5,0.5,0,0,0,1\n");
  const auto red = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"probe", "squares.obj", "--points", "points.csv", "--error", "0.5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = sandbox.Run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return Numbers(Lines(outcome.out).at(1))[7];
  };
  const double light = std::numbers::pi * CentreFormFactor();
  EXPECT_NEAR(red({}), light, 1e-12);
  EXPECT_NEAR(red({"--emittance", "light=3,0,0"}), 3 * CentreFormFactor(), 1e-12);
  EXPECT_GT(red({"--reflectance", "light=0.9,0,0"}), 1.01 * light);
}

// A lamp that lies in a ceiling is seen if it emits, wherever that is said.
TEST(Solve, ChangedMaterialsDecideWhatIsSeen) {
  const Sandbox sandbox;
  sandbox.Write("lamp.obj",
                "mtllib lamp.mtl\n"
                "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nv .2 .2 1\nv .8 .2 1\nv .8 .8 1\nv .2 .8 1\n"
                "usemtl grey\nf 4 3 2 1\nusemtl lamp\nf 8 7 6 5\n");
  sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n0.5,0.5,0,0,0,1\n");
  const auto probe = [&](const std::string& emittance, std::vector<std::string> more) {
    sandbox.Write("lamp.mtl", "newmtl grey\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe " + emittance + "\n");
    std::vector<std::string> arguments = {"probe", "lamp.obj", "--points", "points.csv"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = sandbox.Run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  const std::string lit = probe("10 10 10", {});
  EXPECT_GT(Numbers(Lines(lit).at(1))[7], 1);
  EXPECT_EQ(probe("0 0 0", {"--emittance", "lamp=10,10,10"}), lit);
  EXPECT_EQ(Numbers(Lines(probe("10 10 10", {"--emittance", "lamp=0,0,0"})).at(1))[7], 0);
}

}  // namespace
}  // namespace penumbra
