// The form factor of a point to a polygon of directions.

#include "solver/visibility/form_factor.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

double OfParts(const Vec3& base, const std::array<Vec3, 3>& offset, const Vec3& normal, int halvings) {
  if (halvings == 0) return FormFactorByQuadrature(base, offset, normal);
  const Vec3 &a = offset[0], &b = offset[1], &c = offset[2];
  const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
  return OfParts(base, {a, ab, ca}, normal, halvings - 1) + OfParts(base, {ab, b, bc}, normal, halvings - 1) +
         OfParts(base, {ca, bc, c}, normal, halvings - 1) + OfParts(base, {ab, bc, ca}, normal, halvings - 1);
}

// By quadrature a polygon's form factor is the sum of those of its parts, and the parts are so small that
// their quadrature is exact but for rounding.
TEST(FormFactor, QuadratureOfPartsAddsUp) {
  Random random(511);
  double worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const double size = random.LogUniform(0.005, 1);
    const Vec3 base = RandomDirection(random), normal = (base + RandomDirection(random)).normalized();
    std::array<Vec3, 3> offset = {Vec3::Zero(), size * RandomDirection(random),
                                  size * RandomDirection(random)};
    if (offset[1].cross(offset[2]).dot(base) < 0) std::swap(offset[1], offset[2]);
    const bool above =
        normal.dot(base) > 0 && normal.dot(base + offset[1]) > 0 && normal.dot(base + offset[2]) > 0;
    // Seen too flatly, roundings of the vertices decide.
    if (!above || offset[1].cross(offset[2]).dot(base) < 0.01 * size * size) continue;
    const double parts = OfParts(base, offset, normal, 5);
    worst = std::max(worst, std::abs(FormFactorByQuadrature(base, offset, normal) / parts - 1));
  }
  std::printf("seed 511, largest error %.2g (bound %.2g)\n", worst, kFormFactorError);
  EXPECT_LE(worst, kFormFactorError);
}

}  // namespace
}  // namespace penumbra::scene_test
