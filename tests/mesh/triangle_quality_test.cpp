#include "mesh/interpolants/triangle_quality.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace penumbra {
namespace {

// An equilateral triangle has aspect 1, half a square 45 degrees and the square root of 3; of a sliver angle
// and aspect follow from its sides. Neither depends on the unit of length.
TEST(MeasureQuality, KnowsSimpleTriangles) {
  EXPECT_EQ(MeasureQuality({}).median_aspect, 0);
  for (const double unit : {1e-6, 1.0, 1e6}) {
    IrradianceMesh mesh;
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const Vec3& p : {a, b, c}) mesh.positions.push_back(unit * p);
      mesh.triangles.push_back({{first, first + 1, first + 2}});
    };
    add({0, 0, 0}, {1, 0, 0}, {0.5, 0, std::sqrt(0.75)});
    EXPECT_NEAR(MeasureQuality(mesh).smallest_angle, 60, 1e-9);
    EXPECT_NEAR(MeasureQuality(mesh).median_aspect, 1, 1e-12);
    add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add({0, 0, 0}, {2, 0, 0}, {1, 0.01, 0});
    const TriangleQuality quality = MeasureQuality(mesh);
    EXPECT_NEAR(quality.smallest_angle, std::atan(0.01) * 180 / std::numbers::pi, 1e-9);
    EXPECT_NEAR(quality.median_angle, 45, 1e-9);
    EXPECT_NEAR(quality.below_5_degrees, 1.0 / 3, 1e-12);
    const std::array<double, 6> share = {1.0 / 3, 0, 0, 0, 1.0 / 3, 1.0 / 3};
    EXPECT_EQ(quality.angle_share, share);
    EXPECT_NEAR(quality.slim_area, 0.01 / (std::sqrt(0.1875) + 0.5 + 0.01), 1e-12);
    EXPECT_NEAR(quality.median_aspect, std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(quality.aspect_p95, 100 * std::sqrt(3.0), 1e-9);
  }
}

}  // namespace
}  // namespace penumbra
