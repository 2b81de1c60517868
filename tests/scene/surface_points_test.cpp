// Points spread over surfaces.

#include "solver/scene/surface_points.h"

#include <gtest/gtest.h>

#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

// Patches get points by their areas, to within one, patch after patch; points lie on their patches.
TEST(SurfacePoints, SpreadByArea) {
  Random random(801);
  const Scene scene = FurnishedRoom(random, 5);
  double total = 0;
  for (const Patch& patch : scene.patches) total += patch.area;
  constexpr std::size_t kCount = 5000;
  std::vector<int> count(scene.patches.size());
  PatchId last = 0;
  for (const SurfacePoint& p : SpreadPoints(scene, kCount, 9)) {
    EXPECT_LE(last, p.patch);
    last = p.patch;
    const Patch& patch = scene.patches[static_cast<std::size_t>(p.patch)];
    ++count[static_cast<std::size_t>(p.patch)];
    EXPECT_TRUE(ConvexContains(patch.Vertices(), patch.normal, p.position, 1e-12));
    EXPECT_NEAR(patch.normal.dot(p.position - patch.vertex[0]), 0, 1e-12);
  }
  for (std::size_t p = 0; p < count.size(); ++p)
    EXPECT_NEAR(count[p], kCount * scene.patches[p].area / total, 2);
}

// Within a polygon points are uniform in area: halves of irregular quadrilaterals and of triangles get points
// by their areas, within five standard deviations.
TEST(SurfacePoints, UniformWithinAPolygon) {
  Random random(802);
  for (const Polygon3& polygon :
       {Polygon3{{0, 0, 1}, {3, 0, 1}, {2, 1, 1}, {0, 2, 1}}, Polygon3{{0, 0, 1}, {3, 0, 1}, {0, 2, 1}},
        Polygon3{{0, 0, 1}, {3, 0, 1}, {0, 2, 1}, {0, 2, 1}}}) {
    constexpr int kCount = 20000;
    const Vec3 normal(1, -0.5, 0), on(0.8, 0.4, 1);
    const double share = VectorArea(ClipToHalfSpace(polygon, normal, on)).norm() / VectorArea(polygon).norm();
    int inside = 0;
    for (int i = 0; i < kCount; ++i)
      inside += normal.dot(PointOn(polygon, random.Uniform(), random.Uniform()) - on) > 0;
    EXPECT_NEAR(static_cast<double>(inside) / kCount, share, 5 * 0.5 / std::sqrt(kCount));
  }
}

}  // namespace
}  // namespace penumbra::scene_test
