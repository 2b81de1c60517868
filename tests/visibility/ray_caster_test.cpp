// Rays through a scene.

#include "solver/visibility/point/ray_caster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <span>

#include "solver/base/random.h"
#include "solver/scene/builtin_scenes.h"
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

// Rays that are traced together hit what they hit alone.
TEST(RayCaster, TracesPacketsLikeSingleRays) {
  const Scene scene = *LoadBuiltinScene("office", {});
  const RayCaster caster(scene);
  const auto [low, high] = scene.Bounds();
  Random random(12);
  int blocked = 0;
  for (int i = 0; i < 500; ++i) {
    const auto place = [&, low = low, high = high] {
      return Vec3(random.Uniform(low.x(), high.x()), random.Uniform(low.y(), high.y()),
                  random.Uniform(low.z(), high.z()));
    };
    const Vec3 centre = place(), direction = (place() - centre).normalized();
    const std::size_t count = 1 + random.Index(RayCaster::kPacket);
    std::array<Vec3, RayCaster::kPacket> from, to;
    for (std::size_t k = 0; k < count; ++k) {
      from[k] = centre + 0.3 * (place() - centre);
      to[k] = from[k] + random.Uniform(0, 3) * direction;
    }
    if (i % 10 == 0) from[0] = centre - 1e7 * direction;  // from far away
    std::array<RayCaster::Hit, RayCaster::kPacket> hits;
    caster.CastTogether(std::span(from).first(count), direction, std::span(hits).first(count));
    const std::uint32_t together =
        caster.BlockedTogether(std::span(from).first(count), std::span(to).first(count));
    EXPECT_EQ(together >> count, 0U);
    for (std::size_t k = 0; k < count; ++k) {
      const RayCaster::Hit alone = caster.Cast(from[k], direction);
      EXPECT_EQ(hits[k].patch, alone.patch);
      EXPECT_EQ(hits[k].front, alone.front);
      EXPECT_NEAR(hits[k].distance, alone.distance, 1e-6 * std::max(1.0, alone.distance));
      EXPECT_EQ((together >> k & 1) != 0, caster.Blocked(from[k], to[k]));
      blocked += static_cast<int>(together >> k & 1);
    }
  }
  std::printf("seed 12, %d segments are blocked\n", blocked);
  EXPECT_GT(blocked, 100);
}

}  // namespace
}  // namespace penumbra::scene_test
