// `penumbra grid`: light on a working plane against closed forms, and what it tells of it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/apps/run_program.h"

namespace penumbra {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// A square lamp, 1 m a side, 2 m over the middle of a black floor of 6 by 6 m; a post stands on the floor.
constexpr double kLampHeight = 2, kLampSide = 1;
constexpr double kEmittance[] = {10, 20, 30};  // [W/m^2]
constexpr const char* kLampRoom =
    "mtllib lamp.mtl\nv -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nv -.5 -.5 2\nv -.5 .5 2\nv .5 .5 2\nv .5 -.5 "
    "2\n"
    "o floor\nusemtl black\nf 1 2 3 4\no lamp\nusemtl glow\nf 5 6 7 8\n";
constexpr const char* kLampMaterials = "newmtl black\nKd 0 0 0\nnewmtl glow\nKd 0 0 0\nKe 10 20 30\n";

void WriteLampRoom(const Sandbox& sandbox) {
  sandbox.Write("lamp.obj", kLampRoom);
  sandbox.Write("lamp.mtl", kLampMaterials);
}

// The form factor of a horizontal point to a rectangle of sides a and b in a parallel plane at the distance
// c, one corner of which lies over the point (Hamilton and Morgan 1952); odd in a and in b.
double CornerFactor(double a, double b, double c) {
  const double x = a / c, y = b / c;
  return (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
          y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y))) /
         (2 * std::numbers::pi);
}

// The form factor of the point (x, y) at the height z to the lamp.
double LampFactor(double x, double y, double z) {
  const double half = kLampSide / 2, c = kLampHeight - z;
  return CornerFactor(half - x, half - y, c) - CornerFactor(-half - x, half - y, c) -
         CornerFactor(half - x, -half - y, c) + CornerFactor(-half - x, -half - y, c);
}

// Every value is the closed form's, and what is told of them follows from them.
TEST(Grid, TellsTheLightOfALamp) {
  const Sandbox sandbox;
  WriteLampRoom(sandbox);
  const Outcome outcome = sandbox.Run({"grid", "lamp.obj", "--object", "floor", "--height", "0.5",
                                       "--spacing", "0.6", "--solve", "--json", "-o", "grid.csv"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::vector<std::string> rows = Lines(ReadBytes(sandbox.Path("grid.csv")));
  EXPECT_EQ(rows[0], "x,y,z,nx,ny,nz,exact_r,exact_g,exact_b");
  ASSERT_EQ(rows.size(), 101u);
  double sum = 0, least = 1e9, most = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::vector<std::string> row = Fields(rows[i]);
    const double want = LampFactor(std::stod(row[0]), std::stod(row[1]), std::stod(row[2]));
    for (std::size_t channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(std::stod(row[6 + channel]), kEmittance[channel] * want, 1e-9) << rows[i];
    sum += want;
    least = std::min(least, want);
    most = std::max(most, want);
  }
  const json told = json::parse(outcome.out);
  EXPECT_EQ(told["points"], 100);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(told["mean"][channel], kEmittance[channel] * sum / 100, 1e-9);
    EXPECT_NEAR(told["U0"][channel], least / (sum / 100), 1e-9);
    EXPECT_NEAR(told["Ud"][channel], least / most, 1e-9);
  }
}

// What arrives at a plane, mean times area, is the flux of the lamp times its form factor to the plane.
TEST(Grid, HoldsTheFluxOfALamp) {
  const Sandbox sandbox;
  WriteLampRoom(sandbox);
  const Outcome grid = sandbox.Run({"grid", "lamp.obj", "--object", "floor", "--spacing", "0.1", "--solve",
                                    "--photometric", "--json", "-o", "g.csv"});
  ASSERT_EQ(grid.status, 0) << grid.err;
  const Outcome factor = sandbox.Run({"form-factor", "lamp.obj", "--from", "lamp", "--to", "floor"});
  const double lumens = 179 * (0.265 * 10 + 0.670 * 20 + 0.065 * 30);  // of the lamp, whose area is 1 m^2
  const double arrives = json::parse(grid.out)["mean"].get<double>() * 36;
  EXPECT_NEAR(arrives / (lumens * std::stod(factor.out)), 1, 1e-3);
}

// The page tells the flux of the lamp, E A = 20 W of green light, and 179 * (0.265 * 10 + 0.67 * 20 +
// 0.065 * 30) = 3222 lm, and needs no other file.
TEST(Grid, WritesAPageOfTheRoom) {
  const Sandbox sandbox;
  WriteLampRoom(sandbox);
  const auto page = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"grid",      "lamp.obj", "--object", "floor", "--height", "0.5",
                                          "--spacing", "1",        "--solve",  "-o",    name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = sandbox.Run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return ReadBytes(sandbox.Path(name));
  };
  const std::string watts = page("watts.html", {});
  EXPECT_THAT(watts, HasSubstr("<tr><td>lamp</td><td>1</td><td>10, 20, 30</td></tr>"));
  EXPECT_THAT(watts, HasSubstr("<tr><td>black</td><td>36</td><td>0, 0, 0</td></tr>"));
  EXPECT_THAT(watts, HasSubstr("<svg"));
  EXPECT_THAT(watts, testing::Not(HasSubstr("src=")));
  const std::string lux = page("lux.html", {"--photometric"});
  EXPECT_THAT(lux, HasSubstr("<tr><td>lamp</td><td>1</td><td>3222</td></tr>"));
  EXPECT_THAT(lux, HasSubstr("illuminance [lux]"));
  const Outcome unsolved = sandbox.Run({"grid", "lamp.obj", "--object", "floor", "-o", "a.html"});
  EXPECT_EQ(unsolved.status, 2);
  EXPECT_THAT(unsolved.err, HasSubstr("give --solve"));
}

// Points without light feed `probe`, which finds what the grid found.
TEST(Grid, FeedsProbe) {
  const Sandbox sandbox;
  WriteLampRoom(sandbox);
  const Outcome probed = sandbox.RunScript(
      "penumbra grid lamp.obj --plane z=0.4 --height 0.6 --spacing 1.5 | penumbra probe lamp.obj --points - "
      "--photometric");
  ASSERT_EQ(probed.status, 0) << probed.err;
  const Outcome solved =
      sandbox.Run({"grid", "lamp.obj", "--plane", "z=1", "--spacing", "1.5", "--solve", "--photometric"});
  const std::vector<std::string> a = Lines(probed.out), b = Lines(solved.out);
  ASSERT_EQ(a.size(), 17u);
  ASSERT_EQ(b.size(), 17u);
  for (std::size_t i = 1; i < a.size(); ++i) EXPECT_EQ(Fields(a[i])[7], Fields(b[i])[6]);
  EXPECT_THAT(solved.err, HasSubstr("lux"));
}

// Points inside a solid are left out and counted; what cannot be meant is refused.
TEST(Grid, LeavesOutWhatIsInsideSolids) {
  const Sandbox sandbox;
  sandbox.Write("lamp.mtl", kLampMaterials);
  sandbox.Write(
      "lamp.obj",
      std::string(kLampRoom) +
          "v 1 1 0\nv 2 1 0\nv 2 2 0\nv 1 2 0\nv 1 1 1\nv 2 1 1\nv 2 2 1\nv 1 2 1\no post\n"
          "usemtl black\nf 13 14 15 16\nf 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\nf 12 9 13 16\n");
  const Outcome low =
      sandbox.Run({"grid", "lamp.obj", "--object", "floor", "--height", "0.5", "--spacing", "1"});
  EXPECT_EQ(low.status, 0);
  EXPECT_EQ(Lines(low.out).size(), 36u);
  EXPECT_THAT(low.err, HasSubstr("1 points inside solids"));
  const Outcome high =
      sandbox.Run({"grid", "lamp.obj", "--object", "floor", "--height", "1.5", "--spacing", "1"});
  EXPECT_EQ(Lines(high.out).size(), 37u);
  const Outcome down = sandbox.Run({"grid", "lamp.obj", "--object", "lamp"});
  EXPECT_EQ(down.status, 1);
  EXPECT_THAT(down.err, HasSubstr("nothing of it looks up"));
  EXPECT_THAT(sandbox.Run({"grid", "lamp.obj", "--object", "flor"}).err, HasSubstr("did you mean 'floor'?"));
  for (const std::vector<std::string>& bad : std::vector<std::vector<std::string>>{
           {"grid", "lamp.obj"},
           {"grid", "lamp.obj", "--object", "floor", "--plane", "z=1"},
           {"grid", "lamp.obj", "--plane", "x=1"},
           {"grid", "lamp.obj", "--plane", "z=1", "--spacing", "0"},
           {"grid", "lamp.obj", "--plane", "z=1", "-o", "g.svg"},
           {"grid", "lamp.obj", "--plane", "z=1", "--photometric"},
           {"grid", "lamp.obj", "--plane", "z=1", "--solve", "-o", "g.png"}})
    EXPECT_EQ(sandbox.Run(bad).status, 2) << bad.back();
  const Outcome map = sandbox.Run({"grid", "lamp.obj", "--object", "floor", "--height", "0.5", "--solve",
                                   "--photometric", "-o", "g.svg"});
  EXPECT_EQ(map.status, 0) << map.err;
  EXPECT_THAT(ReadBytes(sandbox.Path("g.svg")), HasSubstr("</svg>"));
  EXPECT_THAT(map.out, HasSubstr("U0"));
}

}  // namespace
}  // namespace penumbra
