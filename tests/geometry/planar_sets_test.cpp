// Hulls, differences and intersections of convex polygons in a plane: areas add up.

#include "solver/geometry/planar_sets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/random.h"

namespace penumbra {
namespace {

// The hull of random points of a plane, on a grid so that points and edges coincide, or anywhere.
Polygon3 RandomConvex(Random& random, const Frame& plane, bool snap) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) {
    Vec2 p(random.Uniform(-1, 1), random.Uniform(-1, 1));
    if (snap) p = (4 * p).array().round() / 4;
    points.push_back(plane.FromPlane(p));
  }
  return ConvexHull(points, plane.n);
}

double Area(const Polygon3& polygon, const Vec3& normal) { return VectorArea(polygon).dot(normal); }

TEST(PlanarSets, AreasAddUp) {
  // What rounding makes of areas of some square metres.
  constexpr double kRounding = 1e-12;
  Random random(641);
  double worst = 0;
  int parted = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 normal = Vec3(random.Uniform(-1, 1), random.Uniform(-1, 1), 1).normalized();
    const Frame plane = MakeFrame({3, 1, random.Uniform(-5, 5)}, normal);
    const Polygon3 a = RandomConvex(random, plane, i % 2 == 0), b = RandomConvex(random, plane, i % 2 == 0);
    if (a.empty() || b.empty()) continue;
    std::vector<Polygon3> left;
    Subtract(a, b, normal, 1e-13, left);
    double area = 0;
    for (const Polygon3& piece : left) {
      EXPECT_GT(Area(piece, normal), 0);
      area += Area(piece, normal);
    }
    const double common = Area(Intersect(a, b, normal, 0), normal);
    worst = std::max(worst, std::abs(area + common - Area(a, normal)));
    parted += !left.empty() && common > 0;
  }
  std::printf("seed 641: %d pairs overlap in part, areas differ by %.2g at most\n", parted, worst);
  EXPECT_LT(worst, kRounding);
  EXPECT_GT(parted, 500);
}

// Counter-clockwise about the normal, and no point outside.
TEST(PlanarSets, HullHoldsItsPoints) {
  Random random(642);
  for (int i = 0; i < 500; ++i) {
    const Frame plane = MakeFrame({1, 2, 3}, Vec3(random.Uniform(-1, 1), 1, 0).normalized());
    std::vector<Vec3> points;
    for (int k = 0; k < 10; ++k)
      points.push_back(plane.FromPlane({0.25 * random.Index(8), 0.25 * random.Index(8)}));
    const Polygon3 hull = ConvexHull(points, plane.n);
    ASSERT_GE(hull.size(), 3U);
    EXPECT_GT(Area(hull, plane.n), 0);
    for (const Vec3& p : points) EXPECT_TRUE(ConvexContains(hull, plane.n, p, 1e-14));
  }
  EXPECT_TRUE(ConvexHull(Polygon3{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, Vec3::UnitZ()).empty());
}

// Polygons whose common edge rounding has moved leave no crack; a real one stays.
TEST(PlanarSets, CracksClose) {
  const Polygon3 whole = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}};
  for (const double gap : {0.0, 1e-15, 1e-11, 1e-6}) {
    const Polygon3 one = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const Polygon3 two = {{1 + gap, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1 + gap, 1, 0}};
    std::vector<Polygon3> left, none;
    Subtract(whole, one, Vec3::UnitZ(), 1e-9, left);
    ASSERT_EQ(left.size(), 1U);
    Subtract(left[0], two, Vec3::UnitZ(), 1e-9, none);
    EXPECT_EQ(none.empty(), gap < 1e-9) << gap;
  }
}

}  // namespace
}  // namespace penumbra
