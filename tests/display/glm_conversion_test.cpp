// Vectors keep their numbers on the way from solver to display and back; what becomes a float becomes the
// nearest one.

#include "display/glm_conversion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "display/unit_vectors.h"
#include "solver/base/random.h"

namespace penumbra {
namespace {

TEST(GlmConversion, KeepsTheNumbers) {
  const Vec3 v(0.1, -1e300, 0x1p-1060);
  EXPECT_EQ(ToEigen(ToGlm(v)), v);
  EXPECT_EQ(ToGlm(v), glm::dvec3(0.1, -1e300, 0x1p-1060));
}

TEST(GlmConversion, RoundsToTheNearestFloats) {
  EXPECT_EQ(ToFloats(glm::dvec3(0.1, -0.1, 1 + 0x1p-24 + 0x1p-50)), glm::vec3(0.1F, -0.1F, 1 + 0x1p-23F));
  EXPECT_EQ(ToPixel(Rgb(0.1, 2, 1e40)), glm::vec3(0.1F, 2.0F, INFINITY));
}

// Unit vectors are as long as rounding lets them be, at any length of what they are made from.
TEST(UnitVectors, HaveLengthOne) {
  Random random(5);
  double worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 v(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
    for (const glm::dvec3& unit :
         {Normalized(v), StableNormalized(1e-300 * v), StableNormalized(1e300 * v)}) {
      worst = std::max(worst, std::abs(glm::length(unit) - 1));
      EXPECT_LT(glm::length(glm::cross(unit, v)), 1e-15 * glm::length(v) * 4);
    }
    worst = std::max(
        {worst, std::abs(glm::length(Perpendicular(v)) - 1), std::abs(glm::dot(Perpendicular(v), v))});
  }
  EXPECT_LT(worst, 1e-15);
  EXPECT_EQ(Normalized(glm::dvec3(0.0)), glm::dvec3(0.0));
  EXPECT_EQ(StableNormalized(glm::dvec3(0.0)), glm::dvec3(0.0));
}

}  // namespace
}  // namespace penumbra
