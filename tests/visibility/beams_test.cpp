// What walls hide together, and what their openings let through, against segments.

#include "solver/visibility/pair/beams.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

#include "solver/scene/builtin_scenes.h"
#include "solver/scene/surface_points.h"
#include "solver/visibility/pair/patch_visibility.h"
#include "solver/visibility/pair/tube_blockers.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

// How far rounding may move what is compared, coordinates being some metres.
constexpr double kRounding = 1e-9;

bool Clear(const Scene& scene, PatchId a, const Vec3& p, PatchId b, const Vec3& q) {
  const auto count = static_cast<PatchId>(scene.patches.size());
  for (PatchId i = 0; i < count; ++i)
    if (i != a && i != b && Cuts(scene.patches[static_cast<std::size_t>(i)], p, q, kRounding)) return false;
  return true;
}

// A wall in the plane y = y that is open where lo < x < hi and 0 < z < top: three rectangles.
void AddWall(Scene& scene, double y, double lo, double hi, double top) {
  const auto add = [&](double x0, double x1, double z0, double z1) {
    if (x1 > x0 && z1 > z0) Add(scene, {{x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}}, 0);
  };
  add(-2, lo, 0, 3);
  add(hi, 2, 0, 3);
  add(lo, hi, top, 3);
}

struct Ends {
  Scene scene;
  PatchId a = 0, b = 1;
  bool Hidden() const {
    const Patch &p = scene.patches[0], &q = scene.patches[1];
    std::vector<PatchId> all(scene.patches.size() - 2), blockers;
    std::iota(all.begin(), all.end(), 2);
    return !FindTubeBlockers(scene, *ClipToEachOther(p.Vertices(), p, q.Vertices(), q), 0, 1, all, blockers);
  }
};

// Two squares that look at each other along y.
Ends Facing(double x) {
  Ends ends;
  AddMaterial(ends.scene, 0.5, 0);
  Add(ends.scene, {{-1, -2, 0}, {-1, -2, 1}, {1, -2, 1}, {1, -2, 0}}, 0);
  Add(ends.scene, {{x - 1, 2, 0}, {x + 1, 2, 0}, {x + 1, 2, 1}, {x - 1, 2, 1}}, 0);
  return ends;
}

// A wall in three parts hides what no part hides; with a doorway it does not; a door as wide as the doorway,
// rounded or not, closes it, and one that leaves a slit of a micrometre does not.
TEST(Beams, WallAndDoor) {
  const Motion turn = [] {
    Random random(9);
    return RandomMotion(random, 5);
  }();
  for (const bool turned : {false, true})
    for (const double slit : {-1.0, 0.0, 1e-6, 0.5}) {
      Ends ends = Facing(0);
      AddWall(ends.scene, 0, -0.4, 0.5, 2);
      if (slit >= 0) Add(ends.scene, {{-0.4, 0, 0}, {0.5 - slit, 0, 0}, {0.5 - slit, 0, 2}, {-0.4, 0, 2}}, 0);
      if (turned) ends.scene = Mapped(ends.scene, turn);
      EXPECT_EQ(ends.Hidden(), slit == 0) << slit;
    }
}

// Two walls with doorways out of line: what is hidden follows from similar triangles. Through a doorway at
// y = -1 from x = -1 to -0.5, points x in [-1, 1] at y = -2 reach, at y = 1, x <= -0.5 + 2 (0.5) = 0.5 ...
// that is 3 (-0.5) - 2 (-1) = 0.5 at most.
TEST(Beams, DoorwaysOutOfLine) {
  for (const double at : {0.45, 0.55}) {
    Ends ends = Facing(0.9);
    AddWall(ends.scene, -1, -1, -0.5, 2);
    AddWall(ends.scene, 1, at, at + 0.4, 2);
    EXPECT_EQ(ends.Hidden(), at > 0.5) << at;
  }
}

// Two patches that face each other, past random walls and furniture that stands about.
Ends RandomEnds(Random& random, bool turned) {
  Ends ends = Facing(random.Uniform(-1.5, 1.5));
  const int walls = 1 + static_cast<int>(random.Index(3));
  for (int w = 0; w < walls; ++w) {
    const double lo = random.Uniform(-1.5, 1), wide = random.Uniform(0.05, 0.8);
    AddWall(ends.scene, -1.2 + 1.2 * w, lo, lo + wide, random.Uniform(0.5, 2.5));
  }
  for (int k = 0; k < 3; ++k) {
    const double x = random.Uniform(-1, 1), y = random.Uniform(-1.9, 1.9);
    AddBox(ends.scene, {x, y, 0}, {x + 0.3, y + 0.3, random.Uniform(0.2, 1.5)}, false, 0);
  }
  if (turned) ends.scene = Mapped(ends.scene, RandomMotion(random, 3));
  return ends;
}

// Random walls, and furniture that stands about: what is hidden has no clear segment; every clear one lies in
// a beam; of every other one a blocker is kept.
TEST(Beams, AgainstSegments) {
  Random random(651);
  int hidden = 0, clear = 0, blocked = 0, dropped = 0, narrowed = 0;
  for (int i = 0; i < 400; ++i) {
    const Ends ends = RandomEnds(random, i % 2 == 1);
    const Scene& scene = ends.scene;
    const Patch &a = scene.patches[0], &b = scene.patches[1];
    std::vector<PatchId> all(scene.patches.size());
    TubeBlockers found;
    std::iota(all.begin(), all.end(), 0);
    const std::optional<TubeEnds> parts = ClipToEachOther(a.Vertices(), a, b.Vertices(), b);
    ASSERT_TRUE(parts);
    const bool seen = FindTubeBlockers(scene, *parts, 0, 1, all, found);
    const std::vector<PatchId>&blockers = found.all, &first = found.first;
    std::vector<PatchId> same;
    EXPECT_EQ(seen, FindTubeBlockers(scene, *parts, 0, 1, all, same)) << i;
    EXPECT_EQ(blockers, same);
    hidden += !seen;
    dropped += static_cast<int>(blockers.size() - first.size());
    const Beams beams = FindBeams(scene, parts->receiver, parts->source, blockers);
    narrowed += seen && !beams.wall_parts.empty();
    for (int k = 0; k < 200; ++k) {
      const double s = random.Uniform(), t = random.Uniform(), u = random.Uniform();
      const Vec3 p = PointOn(a.Vertices(), s, t), q = PointOn(b.Vertices(), u, random.Uniform());
      if (Clear(scene, 0, p, 1, q)) {
        ++clear;
        EXPECT_TRUE(seen) << i;
        const bool in_beam = std::any_of(beams.beams.begin(), beams.beams.end(), [&](const Beam& beam) {
          return std::all_of(beam.stations.begin(), beam.stations.end(), [&](const Polygon3& station) {
            const Vec3 n = VectorArea(station).normalized();
            const double hp = n.dot(p - station[0]), hq = n.dot(q - station[0]);
            return ConvexContains(station, n, p + (q - p) * (hp / (hp - hq)), kRounding);
          });
        });
        EXPECT_TRUE(in_beam) << i;
      } else if (seen) {
        const auto cuts = [&](PatchId id) {
          return Cuts(scene.patches[static_cast<std::size_t>(id)], p, q, -kRounding);
        };
        if (!std::any_of(blockers.begin(), blockers.end(), cuts)) continue;  // by a hair
        ++blocked;
        EXPECT_TRUE(std::any_of(first.begin(), first.end(), [&](PatchId id) {
          return Cuts(scene.patches[static_cast<std::size_t>(id)], p, q, kRounding);
        })) << i;
      }
    }
  }
  std::printf("seed 651: %d hidden, %d narrowed, %d segments clear, %d blocked, %d blockers left out\n",
              hidden, narrowed, clear, blocked, dropped);
  EXPECT_GT(hidden, 20);
  EXPECT_GT(narrowed, 100);
  EXPECT_GT(clear, 1000);
  EXPECT_GT(dropped, 100);
}

// In buildings, as they stand and turned, no pair of patches is lost that two points see each other on.
TEST(Beams, BuildingsLoseNoPair) {
  Random random(652);
  for (const bool turned : {false, true}) {
    Scene scene = *LoadBuiltinScene(turned ? "building-3x1" : "building-2x2", {});
    if (turned) scene = Mapped(scene, RandomMotion(random, 10));
    const PatchVisibility visibility(scene);
    std::set<std::pair<PatchId, PatchId>> pairs;
    for (std::size_t r = 0; r < scene.patches.size(); ++r)
      for (const PatchPair& pair : visibility.SourcesOf(static_cast<PatchId>(r)))
        pairs.emplace(static_cast<PatchId>(r), pair.source);
    std::size_t rays = 0;
    const auto count = static_cast<std::uint32_t>(scene.patches.size());
    for (int k = 0; k < 120000; ++k) {
      const auto from = static_cast<PatchId>(random.Index(count)),
                 to = static_cast<PatchId>(random.Index(count));
      const Patch &a = scene.patches[static_cast<std::size_t>(from)],
                  &b = scene.patches[static_cast<std::size_t>(to)];
      const double s = random.Uniform(), t = random.Uniform(), u = random.Uniform();
      const Vec3 p = PointOn(a.Vertices(), s, t), q = PointOn(b.Vertices(), u, random.Uniform());
      if (a.normal.dot(q - p) < kRounding || b.normal.dot(p - q) < kRounding || !Clear(scene, from, p, to, q))
        continue;
      ++rays;
      EXPECT_TRUE(pairs.count({from, to}) == 1) << from << " sees " << to;
    }
    std::printf("seed 652: %zu patches, %zu pairs, %zu clear segments\n", scene.patches.size(), pairs.size(),
                rays);
    EXPECT_GT(rays, 1000U);
  }
}

}  // namespace
}  // namespace penumbra::scene_test
