// Polygons of sources: fans, quarters, and their join.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/base/random.h"
#include "solver/geometry/polygon.h"
#include "solver/transport/sources/source_polygon.h"

namespace penumbra {
namespace {

Polygon3 RandomConvex(Random& random, int n) {
  std::vector<double> angles;
  for (int k = 0; k < n; ++k) angles.push_back(2 * std::numbers::pi * (k + random.Uniform(0.1, 0.9)) / n);
  Polygon3 polygon;
  const double x = random.Uniform(-5, 5), y = random.Uniform(-5, 5);
  for (const double angle : angles) polygon.emplace_back(x + std::cos(angle), y + std::sin(angle), 1);
  return polygon;
}

constexpr double kRounding = 1e-12;  // of the area of a unit circle

TEST(SourcePolygon, FansTile) {
  Random random(41);
  for (int i = 0; i < 300; ++i) {
    const Polygon3 polygon = RandomConvex(random, 3 + static_cast<int>(random.Index(9)));
    Vec3 sum = Vec3::Zero();
    for (const SourcePolygon& part : Fan(polygon)) {
      EXPECT_GE(VectorArea(part.Vertices()).z(), 0);
      sum += VectorArea(part.Vertices());
    }
    EXPECT_LE((sum - VectorArea(polygon)).norm(), kRounding);
  }
}

TEST(SourcePolygon, QuartersTileAndJoin) {
  Random random(42);
  for (int i = 0; i < 300; ++i) {
    const SourcePolygon whole(RandomConvex(random, 3 + i % 2));
    const std::array<SourcePolygon, 4> q = Quarters(whole);
    Vec3 sum = Vec3::Zero();
    for (const SourcePolygon& quarter : q) {
      EXPECT_GT(VectorArea(quarter.Vertices()).z(), 0);
      sum += VectorArea(quarter.Vertices());
    }
    EXPECT_LE((sum - VectorArea(whole.Vertices())).norm(), kRounding);
    const std::optional<SourcePolygon> joined = JoinQuarters(q[0], q[1], q[2], q[3]);
    ASSERT_TRUE(joined.has_value());
    EXPECT_TRUE(*joined == whole);
    EXPECT_FALSE(JoinQuarters(q[1], q[0], q[2], q[3]).has_value());
    EXPECT_FALSE(JoinQuarters(q[0], q[1], q[2], whole).has_value());
  }
}

}  // namespace
}  // namespace penumbra
