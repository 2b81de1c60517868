// Form factors by rays, by pairs of points and by contours: closed forms, the bias of the printed formula,
// and standard errors that hold.

#include "solver/transport/form_factors/pair_form_factor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "solver/transport/form_factors/source_rays.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra {
namespace {

// A square of one side that looks up, and one of another that looks down from height 1.
Scene SquaresOf(double lower, double upper, bool blocked = false) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 1);
  const auto square = [&](double side, double z, bool up) {
    const double h = side / 2;
    Polygon3 polygon = {{-h, -h, z}, {h, -h, z}, {h, h, z}, {-h, h, z}};
    if (!up) polygon = {polygon.rbegin(), polygon.rend()};
    scene_test::Add(scene, polygon, 0);
  };
  square(lower, 0, true);
  square(upper, 1, false);
  if (blocked) square(0.5, 0.5, true);
  return scene;
}

Scene SquaresAtARightAngle() {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 1);
  scene_test::Add(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0);
  scene_test::Add(scene, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, 0);
  return scene;
}

FormFactorEstimate FactorOf(const Scene& scene, const std::string& method, std::size_t rays,
                            std::uint64_t seed = 1) {
  LinkFormFactorOptions options;
  options.rays = rays;
  options.seed = seed;
  const auto part = [&](PatchId p) {
    return AreaPart{p, {scene.patches[p].Vertices().begin(), scene.patches[p].Vertices().end()}};
  };
  const AreaPart from = part(0), to = part(1);
  return LinkFormFactorMethods().Make(method, options)->Between(scene, {&from, 1}, {&to, 1}, {}).value();
}

SightedPair PairOf(const Scene& scene) {
  return {scene, 0,         1,        scene.patches[0].Vertices(), scene.patches[1].Vertices(), {},
          16,    Random(1), Random(2)};
}

constexpr double kFacingPair = 0.19982489569838738, kEdgePair = 0.2000437760752,
                 kBlockedPair = 0.0995062945989848;

// The closed forms of parallel squares, of squares at a right angle and of a blocked pair lie within four
// stated errors of every method.
TEST(PairFormFactor, ClosedForms) {
  const std::map<std::string, double> largest = {
      {"rays", 0.01}, {"rays-book", 0.02}, {"malley", 0.004}, {"monte-carlo", 0.004}, {"contour", 2e-3}};
  for (const auto& [method, bound] : largest) {
    const auto check = [&](const Scene& scene, double truth) {
      const FormFactorEstimate estimate = FactorOf(scene, method, 100'000);
      std::printf("%-12s %.7f +- %.2g, off by %.2g\n", method.c_str(), estimate.factor, estimate.error,
                  estimate.factor - truth);
      EXPECT_NEAR(estimate.factor, truth, 4 * estimate.error) << method;
      return estimate.error;
    };
    EXPECT_LT(check(SquaresOf(1, 1), kFacingPair), bound) << method;
    check(SquaresAtARightAngle(), kEdgePair);
    EXPECT_LT(check(SquaresOf(1, 1, true), kBlockedPair), 10 * bound) << method;
  }
}

// Contours need no points: without blockers the value is exact up to the quadrature of a logarithm.
TEST(PairFormFactor, ContoursAreExact) {
  EXPECT_NEAR(FactorOf(SquaresOf(1, 1), "contour", 0).factor, kFacingPair, 1e-12);
  EXPECT_NEAR(FactorOf(SquaresAtARightAngle(), "contour", 0).factor, kEdgePair, 1e-7);
}

// A tiny square, of 1e-8 of the area, is as easy as a large one for methods that aim at it.
TEST(PairFormFactor, TinyTargets) {
  const Scene scene = SquaresOf(1, 1e-4);
  for (const char* method : {"rays", "monte-carlo", "contour"}) {
    const FormFactorEstimate estimate = FactorOf(scene, method, 200'000);
    // Reciprocity: 1e-8 times the factor of a point below the centre of a unit square.
    EXPECT_NEAR(estimate.factor, 1e-8 * 0.2394564705, 4 * estimate.error + 1e-15) << method;
    EXPECT_LT(estimate.error, 1e-10) << method;
  }
  // From a corner of the unit square the closed form is 1e-8 (2/3) / (1.5 pi).
  Random random(3);
  const FormFactorEstimate corner =
      PointFactorByRays(PairOf(scene), {0.5, 0.5, 0}, 16, RayFormula::kDisks, &random);
  EXPECT_NEAR(corner.factor, 1.41471e-9, 1e-13);
}

// The printed formula stays below the truth on the average, by n as computed independently of this program:
// 21.8, 6.5, 1.7 and 0.43 % for n = 1, 4, 16, 64. The other formula is right on the average for every n.
TEST(SourceRays, PrintedFormulaIsBiased) {
  const Scene scene = SquaresOf(1, 1);
  const SightedPair pair = PairOf(scene);
  constexpr double kTruth = 0.2394564705;  // of the centre
  const std::map<std::size_t, double> bias = {{1, -0.218}, {4, -0.065}, {16, -0.017}, {64, -0.0043}};
  for (const auto& [n, expected] : bias) {
    Random disks(7), unbiased(7);
    const int runs = static_cast<int>(400'000 / n);
    double printed = 0, mean = 0;
    for (int i = 0; i < runs; ++i) {
      printed += PointFactorByRays(pair, Vec3::Zero(), n, RayFormula::kDisks, &disks).factor / runs;
      mean += PointFactorByRays(pair, Vec3::Zero(), n, RayFormula::kUnbiased, &unbiased).factor / runs;
    }
    std::printf("n = %zu: %.4f, %.4f\n", n, printed / kTruth - 1, mean / kTruth - 1);
    EXPECT_NEAR(printed / kTruth - 1, expected, 0.0015) << n;
    EXPECT_NEAR(mean / kTruth - 1, 0, 0.0015) << n;
  }
}

// Standard errors hold: over many seeds, the root mean square of error / (stated error) is about 1, and
// errors fall as 1 / sqrt(rays).
TEST(PairFormFactor, StandardErrorsHold) {
  const Scene scene = SquaresOf(1, 1, true);
  for (const char* method : {"malley", "monte-carlo"}) {
    double squares = 0, few = 0, many = 0;
    constexpr int kSeeds = 200;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const FormFactorEstimate estimate = FactorOf(scene, method, 1000, static_cast<std::uint64_t>(seed));
      const double ratio = (estimate.factor - kBlockedPair) / estimate.error;
      squares += ratio * ratio / kSeeds;
      few += estimate.error / kSeeds;
      many += FactorOf(scene, method, 4000, static_cast<std::uint64_t>(seed)).error / kSeeds;
    }
    std::printf("%s: rms of error / stated %.3f, stated %.3g with 1000 rays, %.3g with 4000\n", method,
                std::sqrt(squares), few, many);
    EXPECT_NEAR(std::sqrt(squares), 1, 0.2) << method;
    EXPECT_NEAR(few / many, 2, 0.1) << method;
  }
}

// Rays that leave a wall of a closed room arrive: the factors to all walls add up to 1.
TEST(PairFormFactor, RaysOfAClosedRoomAllArrive) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 1);
  scene_test::AddBox(scene, Vec3::Zero(), {2, 3, 2.5}, true, 0);
  LinkFormFactorOptions options;
  options.rays = 1000;
  const auto method = LinkFormFactorMethods().Make("malley", options);
  const auto part = [&](PatchId p) {
    return AreaPart{p, {scene.patches[p].Vertices().begin(), scene.patches[p].Vertices().end()}};
  };
  double sum = 0;
  const AreaPart from = part(0);
  for (PatchId p = 1; p < 6; ++p) {
    const AreaPart to = part(p);
    sum += method->Between(scene, {&from, 1}, {&to, 1}, {}).value().factor;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

}  // namespace
}  // namespace penumbra
