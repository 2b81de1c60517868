// Rays through a scene.

#include "solver/visibility/point/ray_caster.h"

#include <gtest/gtest.h>

#include "solver/scene/surface_points.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

// Rays meet fronts from before and backs from behind, nearest first, and the patch to ignore not at all.
TEST(RayCaster, FrontBackIgnoreAway) {
  Scene scene;
  AddMaterial(scene, 0.5, 0);
  Add(scene, {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}}, 0);  // looks down
  Add(scene, {{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}}, 0);              // looks up
  const RayCaster caster(scene);
  const RayCaster::Hit first = caster.Cast(Vec3::Zero(), Vec3(0, 0, 2));
  EXPECT_EQ(first.patch, 0);
  EXPECT_TRUE(first.front);
  EXPECT_NEAR(first.distance, 0.5, 1e-6);
  const RayCaster::Hit second = caster.Cast(Vec3::Zero(), Vec3::UnitZ(), 0);
  EXPECT_EQ(second.patch, 1);
  EXPECT_FALSE(second.front);
  EXPECT_EQ(caster.Cast(Vec3::Zero(), -Vec3::UnitZ()).patch, kNoPatch);
  EXPECT_EQ(caster.Cast(Vec3(0.9, 0.9, 0), Vec3::UnitZ()).patch, 0);
  EXPECT_EQ(caster.Cast(Vec3(0.9, 0.9, 0), Vec3::UnitZ(), 0).patch, kNoPatch) << "beside the triangle";
  EXPECT_EQ(RayCaster(Scene()).Cast(Vec3::Zero(), Vec3::UnitX()).patch, kNoPatch);
}

// From inside a closed room no ray gets out, and every one meets a front: wherever the room lies.
TEST(RayCaster, ClosedRoomsAreTight) {
  Random random(701);
  for (const double far : {0.0, 10.0, 1e6}) {
    Scene room;
    AddMaterial(room, 0.5, 0);
    AddBox(room, Vec3::Zero(), {4, 3, 2}, true, 0);
    Motion motion = RandomMotion(random, 1);
    motion.shift += far * Vec3(1, 0.5, -0.25);
    const Scene scene = Mapped(room, motion);
    const RayCaster caster(scene);
    int away = 0, backs = 0;
    for (const SurfacePoint& p : SpreadPoints(scene, 5000, 3)) {
      Vec3 direction = RandomDirection(random);
      const Vec3& normal = scene.patches[static_cast<std::size_t>(p.patch)].normal;
      if (direction.dot(normal) < 0) direction = -direction;
      const RayCaster::Hit hit = caster.Cast(p.position, direction, p.patch);
      away += hit.patch == kNoPatch;
      backs += hit.patch != kNoPatch && !hit.front;
    }
    EXPECT_LE(away + backs, 2) << far << " m from the origin";
  }
}

}  // namespace
}  // namespace penumbra::scene_test
