// The path tracer against closed forms, and against another path tracer's numbers: those of
// experiments/peers, or of the folder that PENUMBRA_PEERS names.

#include "experiments/reference/path_tracer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "experiments/reference/reference_points.h"
#include "solver/base/parallel.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/named_scene.h"
#include "test_paths.h"

namespace penumbra {
namespace {

// Errors of this many standard errors mean a fault: with 15 degrees of freedom one in 3,000 estimates
// is farther off by chance. The seeds are fixed, so that a test passes always or never.
constexpr double kSigmas = 4.5;

constexpr double kPi = std::numbers::pi;

Rgb Grey(double x) { return Rgb::Constant(x); }

// Scenes put together patch by patch.
class Built {
 public:
  Built() { scene_.objects.resize(1); }

  PatchId Add(const Polygon3& polygon, const Rgb& reflectance, const Rgb& emittance) {
    const auto at = static_cast<std::int32_t>(scene_.patches.size());
    scene_.materials.push_back({"m", reflectance, emittance});
    scene_.patches.push_back(MakePatch(polygon, at, 0, {at}));
    scene_.faces.push_back({polygon, at, 0});
    return at;
  }
  const Scene& scene() const { return scene_; }

 private:
  Scene scene_;
};

// A rectangle [x0, x1] x [y0, y1] at height z, looking up or down.
Polygon3 Level(double x0, double x1, double y0, double y1, double z, bool up) {
  Polygon3 polygon = {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
  if (!up) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

// The form factor of a point looking up at the origin to the rectangle [0, x] x [0, y] at height z, odd in x
// and y (Howell's catalogue, B-4).
double Corner(double x, double y, double z) {
  const double a = x / z, b = y / z, ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
  return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * kPi);
}
double LevelFormFactor(double x0, double x1, double y0, double y1, double z) {
  return Corner(x1, y1, z) - Corner(x0, y1, z) - Corner(x1, y0, z) + Corner(x0, y0, z);
}

void ExpectWithinError(const ReferenceIrradiance& got, const Rgb& want) {
  for (int c = 0; c < 3; ++c)
    EXPECT_LE(std::abs(got.total[c] - want[c]), kSigmas * got.error[c] + 1e-12 * want[c])
        << "channel " << c << ": " << got.total[c] << " +- " << got.error[c] << " for " << want[c];
}

PathTracerOptions Target(double target) {
  PathTracerOptions options;
  options.target = target;
  return options;
}

// A rectangle over a plane, near and far, straight above and half below the horizon of a tilted receiver
// (by symmetry half of its light is left): the closed form.
TEST(PathTracer, DirectLightOfARectangle) {
  for (const double z : {0.05, 0.4, 1.0, 6.0, 200.0}) {
    Built built;
    built.Add(Level(-1, 1, -0.5, 0.5, z, false), Grey(0), {3, 2, 1});
    const PathTracer tracer(built.scene(), Target(2e-4));
    for (const double x : {0.0, 0.9, 1.5}) {
      const double factor = LevelFormFactor(-1 - x, 1 - x, -0.5, 0.5, z);
      const ReferenceIrradiance got = tracer.At({{x, 0, 0}, Vec3::UnitZ()}, 3);
      ExpectWithinError(got, factor * Rgb(3, 2, 1));
      EXPECT_TRUE((got.total == got.direct).all());
      EXPECT_TRUE((got.error <= 2e-4 * got.total).all());
    }
    // A vertical receiver below the middle sees the half before it; Howell's B-3, twice.
    const double y = 1 / z, b = 0.5 / z, r = std::sqrt(1 + y * y);
    const double side = (std::atan(b) - std::atan(b / r) / r) / kPi;
    ExpectWithinError(tracer.At({{0, 0, 0}, Vec3::UnitX()}, 4), side * Rgb(3, 2, 1));
  }
}

// Triangles are sampled as evenly as rectangles: two of them make one.
TEST(PathTracer, TrianglesAddUp) {
  Built built;
  built.Add({{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}}, Grey(0), Grey(1));
  built.Add({{1, 1, 1}, {1, -1, 1}, {-1, -1, 1}}, Grey(0), Grey(1));
  const PathTracer tracer(built.scene(), Target(2e-4));
  for (const double x : {0.0, 0.4, 3.0, 9.0})
    ExpectWithinError(tracer.At({{x, 0.2, 0}, Vec3::UnitZ()}, 1),
                      Grey(LevelFormFactor(-1 - x, 1 - x, -1.2, 0.8, 1)));
}

// Emitters shine on their front only, everything blocks from both sides, and a blocker in the emitter's or
// the receiver's plane does not.
TEST(PathTracer, WhatShinesAndWhatBlocks) {
  for (const bool blocker_up : {false, true}) {
    Built built;
    built.Add(Level(-1, 1, -1, 1, 2, false), Grey(0), Grey(1));
    built.Add(Level(-1, 1, -1, 1, -2, false), Grey(0), Grey(1));  // looks away from the point
    built.Add(Level(0, 5, -5, 5, 1, blocker_up), Grey(0), Grey(0));
    built.Add(Level(1, 5, -5, 5, 2, blocker_up), Grey(0), Grey(0));
    built.Add(Level(-5, 5, -5, 5, 0, true), Grey(0), Grey(0));
    const PathTracer tracer(built.scene(), Target(2e-4));
    ExpectWithinError(tracer.At({{0, 0, 0}, Vec3::UnitZ()}, 1), Grey(LevelFormFactor(-1, 0, -1, 1, 2)));
    EXPECT_EQ(tracer.At({{3, 0, 0}, Vec3::UnitZ()}, 1).total.maxCoeff(), 0);  // all behind the blocker
  }
}

// One bounce: a grey floor that a far emitter lights evenly, E, sends rho E to a point that looks down at it;
// the back of a ceiling above sends nothing.
TEST(PathTracer, OneBounce) {
  Built built;
  built.Add(Level(-1, 1, -1, 1, 0, true), {0.5, 0.25, 0}, Grey(0));
  built.Add(Level(-1, 1, -1, 1, 2, true), Grey(0.9), Grey(0));  // looks up: its back is black
  constexpr double kFar = 3000;
  built.Add({{kFar, 40, 60}, {kFar, -40, 60}, {kFar, -40, 100}, {kFar, 40, 100}}, Grey(0), Grey(1));
  ASSERT_LT(built.scene().patches.back().normal.x(), 0);
  const PathTracer tracer(built.scene(), Target(3e-4));
  const ReferenceIrradiance floor = tracer.At({{0, 0, 0}, Vec3::UnitZ()}, 1);
  EXPECT_GT(floor.total[0], 0);
  // The floor is lit to within 1e-3 of its middle's light: a metre in 3,000, and its cosine to the ground.
  const ReferenceIrradiance above = tracer.At({{0, 0, 0.5}, -Vec3::UnitZ()}, 2);
  const double factor = LevelFormFactor(-1, 1, -1, 1, 0.5);
  for (int c = 0; c < 2; ++c) {
    const double want = factor * floor.total[c] * (c == 0 ? 0.5 : 0.25);
    EXPECT_NEAR(above.total[c], want, kSigmas * above.error[c] + 2e-3 * want);
  }
  EXPECT_EQ(above.total[2], 0);
  EXPECT_EQ(above.direct[0], 0);
}

// In the furnace, reflectance and emittance 1/2, irradiance is 1 everywhere; in a channel of its own, too.
TEST(PathTracer, Furnace) {
  Scene scene = *LoadBuiltinScene("furnace", {});
  for (Material& material : scene.materials) {
    material.reflectance = {0.5, 0.25, 0.75};
    material.emittance = 1 - material.reflectance;
  }
  const PathTracer tracer(scene, Target(2e-3));
  for (const Vec3& p : {Vec3(0.5, 0.5, 0), Vec3(0.01, 0.98, 0), Vec3(0.3, 0.2, 0)})
    ExpectWithinError(tracer.At({p, Vec3::UnitZ()}, 1), Grey(1));
  // A light meter in the middle of the room, however it is turned.
  ExpectWithinError(tracer.At({{0.4, 0.5, 0.6}, Vec3(1, 2, -2) / 3}, 1), Grey(1));
}

// No light, no irradiance; and the same bytes for any number of threads.
TEST(PathTracer, SameForAnyNumberOfThreads) {
  const Scene scene = *LoadBuiltinScene("cornell", {});
  const std::vector<IrradiancePoint> points = ReferencePoints(scene, 6, 1);
  std::vector<std::vector<ReferenceIrradiance>> found;
  for (const int threads : {1, 3}) {
    SetThreadCount(threads);
    found.push_back(PathTracer(scene, Target(0.02)).At(points));
  }
  SetThreadCount(0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE((found[0][i].total == found[1][i].total).all());
    EXPECT_TRUE((found[0][i].error == found[1][i].error).all());
  }
  EXPECT_EQ(PathTracer(Scene(), {}).At({Vec3::Zero(), Vec3::UnitZ()}, 1).total.maxCoeff(), 0);
}

// The stated errors are true: over many independent estimates of one value, the squares of the errors in
// units of the stated ones average to 15/13, as Student's distribution has it.
TEST(PathTracer, StandardErrorsAreHonest) {
  const Scene scene = *LoadBuiltinScene("furnace", {});
  const PathTracer tracer(scene, Target(0.01));
  double sum = 0;
  constexpr int kRuns = 100;
  for (int run = 0; run < kRuns; ++run) {
    const ReferenceIrradiance got =
        tracer.At({{0.3, 0.6, 0}, Vec3::UnitZ()}, static_cast<std::uint64_t>(run));
    sum += (got.total[0] - 1) * (got.total[0] - 1) / (got.error[0] * got.error[0]);
  }
  std::printf("mean square in standard errors: %.3f\n", sum / kRuns);
  // The mean of 100 squares scatters by some 0.18; and estimates end when they seem good.
  EXPECT_GT(sum / kRuns, 15.0 / 13 - 0.5);
  EXPECT_LT(sum / kRuns, 15.0 / 13 + 0.5);
}

// A room with a lamp and a block against what another path tracer found.
TEST(PathTracer, AgreesWithAnotherTracer) {
  const char* named = std::getenv("PENUMBRA_PEERS");
  const std::filesystem::path folder =
      named ? std::filesystem::path(named)
            : std::filesystem::path(PENUMBRA_SOURCE_DIR) / "experiments" / "peers";
  std::ifstream file(folder / "box_reference.csv");
  ASSERT_TRUE(file) << "no box_reference.csv in " << folder;
  const Scene scene = ReadNamedScene((folder / "box.obj").string(), {});
  const PathTracer tracer(scene, Target(0.003));
  std::string line;
  std::getline(file, line);
  double sum = 0, worst = 0;
  int count = 0;
  for (std::uint64_t row = 0; std::getline(file, line); ++row) {
    if (row % 4 != 0) continue;
    std::stringstream fields(line);
    std::array<double, 15> value{};
    for (double& v : value) {
      std::string text;
      std::getline(fields, text, ',');
      v = std::stod(text);
    }
    const ReferenceIrradiance got =
        tracer.At({{value[0], value[1], value[2]}, {value[3], value[4], value[5]}}, row);
    for (std::size_t c = 0; c < 3; ++c) {
      const double other = value[9 + c], own = got.error[static_cast<int>(c)];
      const double off = std::abs(got.total[static_cast<int>(c)] - value[6 + c]) / std::hypot(own, other);
      sum += off * off;
      worst = std::max(worst, off);
      ++count;
    }
    EXPECT_LE((got.direct - Rgb(value[12], value[13], value[14])).abs().maxCoeff(), 1e-3);
  }
  std::printf("%d values: mean square %.3f, worst %.2f standard errors\n", count, sum / count, worst);
  EXPECT_EQ(count, 66);
  // 22 points of three channels that go together: their mean square scatters by some 0.4.
  EXPECT_GT(sum / count, 0.4);
  EXPECT_LT(sum / count, 2.2);
  EXPECT_LE(worst, kSigmas);
}

}  // namespace
}  // namespace penumbra
