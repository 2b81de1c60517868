#include "solver/geometry/polygon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/base/random.h"

namespace penumbra {
namespace {

using ::testing::IsEmpty;

Vec3 RandomUnit(Random& random) {
  const double z = random.Uniform(-1, 1), angle = random.Uniform(0, 2 * std::numbers::pi),
               r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// A regular polygon of unit circumradius about `centre`, counter-clockwise about `normal`.
Polygon3 Regular(int n, const Vec3& centre, const Vec3& normal) {
  const Frame frame = MakeFrame(centre, normal);
  Polygon3 polygon;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    polygon.push_back(frame.FromPlane({std::cos(angle), std::sin(angle)}));
  }
  return polygon;
}

TEST(Polygon, AreaCentroidAndDiameterOfRegularPolygons) {
  // A regular polygon has the area n/2 sin(2 pi/n), its centre for centroid, and its normal; far away too.
  Random random(1);
  double worst = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const int n = 3 + static_cast<int>(random.Index(10));
    const double far = trial % 2 ? random.LogUniform(1, 1e6) : 1;
    const Vec3 normal = RandomUnit(random), centre = far * RandomUnit(random);
    const Polygon3 polygon = Regular(n, centre, normal);
    const double area = 0.5 * n * std::sin(2 * std::numbers::pi / n);
    worst = std::max(worst, (VectorArea(polygon) - area * normal).norm() / far);
    worst = std::max(worst, (Centroid(polygon) - centre).norm() / far);
    if (n % 2 == 0) worst = std::max(worst, std::abs(Diameter(polygon) - 2) / far);
  }
  std::printf("largest error relative to the distance: %.3g\n", worst);
  EXPECT_LE(worst, 1e-14);
}

// The normal of a strip, however thin and turned, is at right angles to its length but for a few roundings of
// its coordinates; across its width the same roundings turn it by more the thinner it is.
TEST(Polygon, NormalsOfThinStrips) {
  Random random(2);
  double worst_along = 0, worst_across = 0;
  for (int trial = 0; trial < 10000; ++trial) {
    const double width = random.LogUniform(1e-9, 1e-1);
    const Frame frame = MakeFrame(2 * RandomUnit(random), RandomUnit(random));
    Polygon3 strip;
    for (const Vec2& p : {Vec2(0, 0), Vec2(width, 0), Vec2(width, 1), Vec2(0, 1)})
      strip.push_back(frame.FromPlane(p));
    std::rotate(strip.begin(), strip.begin() + static_cast<std::ptrdiff_t>(random.Index(4)), strip.end());
    const Vec3 normal = VectorArea(strip).normalized();
    worst_along = std::max(worst_along, std::abs(normal.dot(frame.v)));
    worst_across = std::max(worst_across, std::abs(normal.dot(frame.u)) * width);
  }
  std::printf("largest error along %.3g, across times the width %.3g\n", worst_along, worst_across);
  // Coordinates up to 3, one rounding of 4.4e-16 at either end of an edge; sines down to 1e-3 cost up to
  // three digits of 1.1e-16.
  EXPECT_LE(worst_along, 4 * 4.5e-16 + 1.1e-13);
  EXPECT_LE(worst_across, 4 * 4.5e-16);
}

TEST(Polygon, DegenerateOnes) {
  // Fewer than three vertices, or three on a line, have no area, and their mean for centroid.
  EXPECT_EQ(VectorArea(Polygon3{}), Vec3::Zero());
  EXPECT_EQ(VectorArea(Polygon3{{1, 2, 3}, {4, 5, 6}}), Vec3::Zero());
  EXPECT_EQ(Centroid(Polygon3{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}), Vec3(2, 0, 0));
  EXPECT_EQ(Diameter(Polygon3{{1, 1, 1}}), 0);
  EXPECT_EQ(SignedArea(Polygon2{{0, 0}, {0, 1}, {1, 0}}), -0.5);
}

TEST(Polygon, FramesAreOrthonormalAndReturn) {
  // Every frame is right-handed; a point of the plane comes back from its coordinates.
  Random random(2);
  double worst = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 normal = trial < 3 ? Vec3(Vec3::Unit(trial)) : RandomUnit(random);
    const Polygon3 polygon = Regular(5, RandomUnit(random), normal);
    for (const Frame& frame : {MakeFrame(polygon[0], normal), PolygonFrame(polygon)}) {
      worst = std::max(worst, (frame.u.cross(frame.v) - frame.n).norm());
      worst = std::max(worst, (frame.n - normal).norm());
      for (const Vec3& p : polygon) worst = std::max(worst, (frame.FromPlane(frame.ToPlane(p)) - p).norm());
    }
  }
  std::printf("largest error: %.3g\n", worst);
  EXPECT_LE(worst, 1e-14);
}

TEST(Polygon, TheTwoPartsOfACutAddUp) {
  // A plane cuts a convex polygon into two whose areas add up, each on its side; vertices in the plane go to
  // both.
  Random random(3);
  double worst = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Polygon3 polygon = Regular(3 + static_cast<int>(random.Index(6)), Vec3::Zero(), RandomUnit(random));
    const Vec3 normal = RandomUnit(random);
    const Vec3 point = trial % 2 ? Vec3(0.5 * RandomUnit(random)) : polygon[0];
    const Polygon3 front = ClipToHalfSpace(polygon, normal, point),
                   back = ClipToHalfSpace(polygon, -normal, point);
    worst = std::max(worst, (VectorArea(front) + VectorArea(back) - VectorArea(polygon)).norm());
    for (const Vec3& p : front) worst = std::max(worst, -normal.dot(p - point));
    for (const Vec3& p : back) worst = std::max(worst, normal.dot(p - point));
  }
  std::printf("largest error: %.3g\n", worst);
  EXPECT_LE(worst, 1e-14);
  const Polygon3 square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_THAT(ClipToHalfSpace(square, Vec3::UnitX(), {1, 0, 0}), IsEmpty()) << "only an edge remains";
  EXPECT_EQ(ClipToHalfSpace(square, Vec3::UnitX(), {0, 0, 0}), square);
}

TEST(Polygon, ContainsItsCentroidAndNothingBeyondItsCircle) {
  // A convex polygon contains the mixtures of its vertices and no point outside its circle; the border
  // counts.
  Random random(4);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 normal = RandomUnit(random);
    const Polygon3 polygon = Regular(3 + static_cast<int>(random.Index(6)), Vec3::Zero(), normal);
    const Frame frame = MakeFrame(Vec3::Zero(), normal);
    const double angle = random.Uniform(0, 7);
    EXPECT_TRUE(ConvexContains(polygon, normal, 0.9 * random.Uniform() * polygon[0], 0));
    EXPECT_TRUE(ConvexContains(polygon, normal, 0.5 * (polygon[0] + polygon[1]), 1e-15));
    EXPECT_FALSE(ConvexContains(polygon, normal,
                                frame.FromPlane({1.01 * std::cos(angle), 1.01 * std::sin(angle)}), 0));
  }
}

}  // namespace
}  // namespace penumbra
