// The rules that average over receivers.

#include "solver/transport/links/cubature.h"

#include <gtest/gtest.h>

#include "solver/base/random.h"
#include "solver/geometry/polygon.h"

namespace penumbra {
namespace {

double Mean(const Polygon3& polygon, int refinement, int i, int j) {
  double sum = 0, weights = 0;
  for (const CubaturePoint& point : Cubature(polygon, refinement)) {
    EXPECT_GT(point.weight, 0);
    weights += point.weight;
    sum += point.weight * std::pow(point.position.x(), i) * std::pow(point.position.y(), j);
  }
  EXPECT_NEAR(weights, 1, 1e-14);
  return sum;
}

// The rule over a triangle is exact for polynomials of degree 2: means of x^i y^j over the standard triangle
// are 2 i! j! / (i + j + 2)!.
TEST(Cubature, TrianglesAreExactForDegreeTwo) {
  const Polygon3 triangle = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  for (int refinement = 0; refinement < 3; ++refinement)
    for (int i = 0; i <= 2; ++i)
      for (int j = 0; i + j <= 2; ++j)
        EXPECT_NEAR(Mean(triangle, refinement, i, j),
                    2 * std::tgamma(i + 1) * std::tgamma(j + 1) / std::tgamma(i + j + 3), 1e-15)
            << i << " " << j;
}

// The rule over a rectangle is exact for degree 3 in each coordinate.
TEST(Cubature, RectanglesAreExactForDegreeThree) {
  const Polygon3 rectangle = {{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {0, 1, 1}};
  for (int refinement = 0; refinement < 3; ++refinement)
    for (int i = 0; i <= 3; ++i)
      for (int j = 0; j <= 3; ++j)
        EXPECT_NEAR(Mean(rectangle, refinement, i, j), std::pow(2, i) / ((i + 1) * (j + 1)), 1e-14);
}

// Over irregular quadrilaterals linear functions are averaged exactly: to the centroid. Over other polygons
// too. Points lie inside.
TEST(Cubature, MeansOfLinearFunctionsAreCentroids) {
  Random random(451);
  for (int round = 0; round < 300; ++round) {
    const int n = 3 + static_cast<int>(random.Index(4));
    Polygon3 polygon;
    // On a circle: convex whatever the angles.
    for (int i = 0; i < n; ++i) {
      const double angle = (i + random.Uniform(-0.4, 0.4)) * 6.283185307179586 / n;
      polygon.push_back({std::cos(angle), std::sin(angle), 3});
    }
    for (int refinement = 0; refinement < 3; ++refinement) {
      Vec3 mean = Vec3::Zero();
      for (const CubaturePoint& point : Cubature(polygon, refinement)) {
        mean += point.weight * point.position;
        EXPECT_TRUE(ConvexContains(polygon, Vec3::UnitZ(), point.position, 0));
      }
      EXPECT_LE((mean - Centroid(polygon)).norm(), 1e-13);
    }
  }
}

}  // namespace
}  // namespace penumbra
