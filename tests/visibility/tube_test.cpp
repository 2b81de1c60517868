// Tubes, and the pairs of patches that they decide about, against brute force.

#include "solver/visibility/pair/tube.h"

#include <gtest/gtest.h>

#include "solver/scene/surface_points.h"
#include "solver/visibility/pair/patch_visibility.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

Patch RandomPatch(Random& random, const Vec3& centre, bool snap) {
  for (;;) {
    const Frame frame = MakeFrame(centre + RandomPoint(random, 0.5), RandomDirection(random));
    const int n = 3 + static_cast<int>(random.Index(2));
    Polygon3 polygon;
    for (int i = 0; i < n; ++i) {
      const double angle = (i + random.Uniform(-0.2, 0.2)) * 2 * std::numbers::pi / n;
      polygon.push_back(frame.FromPlane({std::cos(angle), std::sin(angle)}));
    }
    if (!snap) return MakePatch(polygon, 0, 0, {});
    // Axis-aligned rectangles with coordinates in quarters.
    const int axis = static_cast<int>(random.Index(3)), u = (axis + 1) % 3, v = (axis + 2) % 3;
    Vec3 corner = (4 * (centre + RandomPoint(random, 1))).array().round() / 4, eu = Vec3::Zero(),
         ev = Vec3::Zero();
    eu[u] = 0.25 * (1 + random.Index(6));
    ev[v] = (random.Index(2) == 0 ? 0.25 : -0.25) * (1 + random.Index(6));
    return MakePatch(Polygon3{corner, corner + eu, corner + eu + ev, corner + ev}, 0, 0, {});
  }
}

// A tube never misses what cuts a segment between its ends, and is hidden only by what cuts all segments. The
// ends are cut as the callers do, to lie before each other's planes.
TEST(Tube, AgainstSegments) {
  Random random(601);
  int missed = 0, hidden = 0, blocked = 0;
  for (int i = 0; i < 6000; ++i) {
    const bool snap = i % 2 == 0;
    const Patch one = RandomPatch(random, Vec3::Zero(), snap), two = RandomPatch(random, {0, 0, 3}, snap);
    const Polygon3 a = ClipToHalfSpace(one.Vertices(), two.normal, two.vertex[0]);
    const Polygon3 b = ClipToHalfSpace(two.Vertices(), one.normal, one.vertex[0]);
    if (a.empty() || b.empty()) continue;
    const Patch blocker = RandomPatch(random, {0, 0, 1.5}, snap);
    const Tube tube(a, b);
    const bool misses = tube.Misses(blocker.Vertices(), blocker.normal);
    const bool hides = tube.HiddenBy(blocker.Vertices(), blocker.normal);
    EXPECT_FALSE(misses && hides) << i;
    missed += misses;
    hidden += hides;
    const auto point_in = [&](const Polygon3& polygon) {
      // A random point of a fan's triangle.
      const std::size_t k = 2 + random.Index(static_cast<std::uint32_t>(polygon.size()) - 2);
      return PointOn(Polygon3{polygon[0], polygon[k - 1], polygon[k]}, random.Uniform(), random.Uniform());
    };
    int cut = 0;
    constexpr int kSegments = 60;
    for (int k = 0; k < kSegments; ++k) {
      const Vec3 p = point_in(a), q = point_in(b);
      const bool cuts = Cuts(blocker, p, q, -1e-12);
      cut += cuts;
      if (hides) {
        EXPECT_TRUE(Cuts(blocker, p, q, 1e-12)) << i;
      }
    }
    if (cut > 0) {
      ++blocked;
      EXPECT_FALSE(misses) << i;
    }
  }
  std::printf("seed 601: %d tubes missed, %d blocked, %d hidden\n", missed, blocked, hidden);
  EXPECT_GT(missed, 500);
  EXPECT_GT(blocked, 500);
  EXPECT_GT(hidden, 10);
}

// Pairs are symmetric and ascending; two points that see each other, front to front, lie on a pair; what cuts
// a segment between two points of a pair's fronts is one of its blockers.
TEST(PatchVisibility, AgainstSegments) {
  Random random(602);
  int pairs = 0, segments = 0;
  for (int i = 0; i < 12; ++i) {
    Scene scene = FurnishedRoom(random, 4);
    if (i % 2 == 1) scene = Mapped(scene, RandomMotion(random, 5));
    const PatchVisibility visibility(scene);
    const auto count = static_cast<PatchId>(scene.patches.size());
    const auto find = [&](PatchId receiver, PatchId source) -> const PatchPair* {
      for (const PatchPair& pair : visibility.SourcesOf(receiver))
        if (pair.source == source) return &pair;
      return nullptr;
    };
    for (PatchId r = 0; r < count; ++r) {
      PatchId last = -1;
      for (const PatchPair& pair : visibility.SourcesOf(r)) {
        EXPECT_LT(last, pair.source);
        last = pair.source;
        const PatchPair* back = find(pair.source, r);
        ASSERT_NE(back, nullptr);
        EXPECT_TRUE(std::ranges::equal(visibility.Blockers(pair), visibility.Blockers(*back)));
        EXPECT_TRUE(std::ranges::is_sorted(visibility.Blockers(pair)));
        EXPECT_EQ(pair.visibility == Visibility::kVisible, pair.blocker_count == 0);
        ++pairs;
      }
    }
    const std::vector<SurfacePoint> points = SpreadPoints(scene, 150, 70 + static_cast<std::uint64_t>(i));
    for (const SurfacePoint& p : points)
      for (const SurfacePoint& q : points) {
        const Vec3 d = q.position - p.position;
        if (p.patch == q.patch || scene.patches[static_cast<std::size_t>(p.patch)].normal.dot(d) < 1e-9 ||
            scene.patches[static_cast<std::size_t>(q.patch)].normal.dot(d) > -1e-9)
          continue;
        std::vector<PatchId> between;
        bool clear = true;
        for (PatchId k = 0; k < count; ++k) {
          if (k == p.patch || k == q.patch) continue;
          const Patch& patch = scene.patches[static_cast<std::size_t>(k)];
          if (Cuts(patch, p.position, q.position, -1e-9)) between.push_back(k);
          clear = clear && !Cuts(patch, p.position, q.position, 1e-9);
        }
        const PatchPair* pair = find(p.patch, q.patch);
        if (clear) {
          EXPECT_NE(pair, nullptr) << "room " << i << ": " << p.patch << " sees " << q.patch;
        }
        if (!pair) continue;
        const std::span<const PatchId> blockers = visibility.Blockers(*pair);
        for (const PatchId k : between)
          EXPECT_TRUE(std::ranges::binary_search(blockers, k))
              << "room " << i << ": " << k << " stands between " << p.patch << " and " << q.patch;
        ++segments;
      }
  }
  std::printf("seed 602: %d pairs, %d segments\n", pairs, segments);
}

// No scene, no pairs.
TEST(PatchVisibility, EmptyAndSingle) {
  Scene scene;
  const PatchVisibility none(scene);
  AddMaterial(scene, 0.5, 1);
  Add(scene, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0);
  const PatchVisibility one(scene);
  EXPECT_TRUE(one.SourcesOf(0).empty());
}

}  // namespace
}  // namespace penumbra::scene_test
