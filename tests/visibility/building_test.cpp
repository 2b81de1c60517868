#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/base/random.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/surface_points.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {
namespace {

// Light cannot leave a building: rays from its fronts all end on a patch, and some come through doorways.
TEST(Building, NoRayEscapes) {
  const Scene scene = *LoadBuiltinScene("building-2x2", {});
  const RayCaster caster(scene);
  Random random(11);
  std::size_t to_other_rooms = 0;
  const std::vector<SurfacePoint> points = SpreadPoints(scene, 20000, 5);
  for (const SurfacePoint& point : points) {
    const Frame frame = MakeFrame(point.position, scene.patches[point.patch].normal);
    const double r = std::sqrt(random.Uniform()), a = 2 * std::numbers::pi * random.Uniform();
    const Vec3 direction =
        r * std::cos(a) * frame.u + r * std::sin(a) * frame.v + std::sqrt(std::max(0.0, 1 - r * r)) * frame.n;
    const RayCaster::Hit hit = caster.Cast(point.position, direction, point.patch);
    EXPECT_NE(hit.patch, kNoPatch) << point.position.transpose() << " along " << direction.transpose();
    const Vec3 end = point.position + hit.distance * direction;
    to_other_rooms += (point.position.x() < 4) != (end.x() < 4.2) ? 1 : 0;
  }
  EXPECT_GT(to_other_rooms, 50U);
}

}  // namespace
}  // namespace penumbra
