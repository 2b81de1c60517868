#include "mesh/triangulation/weld.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/triangulation/leaf_triangulation.h"
#include "mesh_test_scenes.h"

namespace penumbra {
namespace {

using mesh_test::AddBox;
using mesh_test::AddPatch;
using mesh_test::EmptyScene;
using mesh_test::Place;
using mesh_test::PlaceOf;
using mesh_test::RefineAtRandom;
using mesh_test::RoundCoordinates;
using mesh_test::Tilt;

// The positions of the mesh's vertices on the segment, to rounding.
std::vector<Place> OnSegment(const PatchTriangulation& mesh, const Vec3& a, const Vec3& b) {
  std::vector<Place> on;
  std::vector<bool> used(mesh.positions.size(), false);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t.vertex) used[v] = true;
  const Vec3 along = (b - a).normalized();
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3 p = mesh.positions[v] - a;
    const double at = along.dot(p);
    if (used[v] && (p - at * along).norm() < 1e-9 && at > -1e-9 && at < (b - a).norm() + 1e-9)
      on.push_back(PlaceOf(mesh.positions[v]));
  }
  std::sort(on.begin(), on.end());
  return on;
}

// A room whose walls are refined at random and crossed by random lines, tilted and rounded or not, with a
// wall in two pieces: along every edge that two patches share, in full or in part, both have the same
// vertices, to the bit; and every patch still conforms.
TEST(WeldOutlines, SharedEdgesHaveTheSameVertices) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Scene scene = EmptyScene();
    AddBox(scene, {0, 0, 0}, {1, 0.8, 0.6}, true);
    // A second box beside it, lower: its edges run along parts of the first one's.
    AddBox(scene, {1, 0, 0}, {1.5, 0.5, 0.3}, true);
    if (seed % 2 == 0) Tilt(scene, 7.0 * static_cast<double>(seed));
    if (seed % 3 == 0) RoundCoordinates(scene, 12);
    ElementForest forest(scene);
    std::vector<PatchBorders> borders;
    std::vector<PatchDSets> dsets;
    const auto count = static_cast<PatchId>(scene.patches.size());
    for (PatchId p = 0; p < count; ++p) {
      RefineAtRandom(forest, p, random, static_cast<int>(random.Index(12)), 5);
      const Frame frame = PolygonFrame(scene.patches[p].Vertices());
      std::vector<Discontinuity> found;
      for (int i = 0; i < 4; ++i) {
        const auto point = [&] {
          return frame.ToPlane(
              LatticePosition(scene.patches[p], {static_cast<std::int32_t>(random.Index(kLatticeSize)),
                                                 static_cast<std::int32_t>(random.Index(kLatticeSize))}));
        };
        const Vec2 a = point(), b = point();
        found.push_back(mesh_test::Segment(a - 2 * (b - a), b + 2 * (b - a), 1));
      }
      dsets.push_back(ActivateDiscontinuities(forest, p, found, {}));
    }
    for (PatchId p = 0; p < count; ++p) borders.emplace_back(forest, p, dsets[p]);
    WeldOutlines(scene, borders);
    std::vector<PatchTriangulation> meshes;
    for (PatchId p = 0; p < count; ++p) {
      meshes.push_back(TriangulateLeaves(forest, p, dsets[p], borders[p]));
      meshes.back().Validate(scene.patches[p]);
    }
    std::size_t shared = 0, vertices = 0;
    for (PatchId p = 0; p < count; ++p)
      for (PatchId q = p + 1; q < count; ++q)
        for (std::int32_t k = 0; k < 4; ++k)
          for (std::int32_t l = 0; l < 4; ++l) {
            const Patch &one = scene.patches[p], &two = scene.patches[q];
            const Vec3 &a = one.vertex[k], &b = one.vertex[(k + 1) % 4], &c = two.vertex[l],
                       &d = two.vertex[(l + 1) % 4];
            const Vec3 along = (b - a).normalized();
            if ((c - a).cross(along).norm() > 1e-9 || (d - a).cross(along).norm() > 1e-9) continue;
            const double length = (b - a).norm(), tc = along.dot(c - a), td = along.dot(d - a);
            const double t0 = std::max(0.0, std::min(tc, td)), t1 = std::min(length, std::max(tc, td));
            if (t1 - t0 < 1e-6) continue;
            ++shared;
            const std::vector<Place> first = OnSegment(meshes[p], a + t0 * along, a + t1 * along);
            vertices += first.size();
            EXPECT_EQ(first, OnSegment(meshes[q], a + t0 * along, a + t1 * along)) << p << ", " << q;
          }
    EXPECT_GT(shared, 24U);
    EXPECT_GT(vertices, 3 * shared);
  }
}

}  // namespace
}  // namespace penumbra
