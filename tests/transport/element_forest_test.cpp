// The quadtrees of elements: geometry, topology, balance.

#include "solver/transport/links/element_forest.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

// A triangle and irregular convex quadrilaterals in a random attitude.
Scene SomePatches(Random& random) {
  Scene scene;
  AddMaterial(scene, 0.5, 0);
  for (int k = 0; k < 4; ++k) {
    const int n = k == 0 ? 3 : 4;
    const Frame frame = MakeFrame(RandomPoint(random, 5), RandomDirection(random));
    Polygon3 polygon;
    for (int i = 0; i < n; ++i) {
      const double angle = (i + random.Uniform(-0.25, 0.25)) * 2 * std::numbers::pi / n;
      polygon.push_back(frame.FromPlane({std::cos(angle), std::sin(angle)}));
    }
    Add(scene, polygon, 0);
  }
  return scene;
}

void SplitAtRandom(ElementForest& forest, PatchId patch, Random& random, int splits) {
  for (int i = 0; i < splits; ++i) {
    ElementId id = ElementForest::Root(patch);
    while (!forest[id].IsLeaf()) id = forest[id].first_child + static_cast<ElementId>(random.Index(4));
    if (forest[id].level < 9) forest.Subdivide(id);
  }
}

// Equal lattice points are equal positions to the bit, roots keep the bits of their patch's vertices,
// children lie within rounding where Quarters() says, and fill their parents.
TEST(ElementForest, GeometryOfChildren) {
  Random random(401);
  for (int round = 0; round < 20; ++round) {
    const Scene scene = SomePatches(random);
    ElementForest forest(scene);
    for (PatchId p = 0; p < 4; ++p) {
      SplitAtRandom(forest, p, random, 60);
      const Patch& patch = scene.patches[static_cast<std::size_t>(p)];
      for (std::size_t k = 0; k < static_cast<std::size_t>(patch.size); ++k)
        EXPECT_EQ(forest[ElementForest::Root(p)].vertex[k], patch.vertex[k]);
      std::map<LatticePoint, Vec3> at;
      double area = 0;
      forest.ForEachBelow(ElementForest::Root(p), [&](ElementId id) {
        const Element& e = forest[id];
        for (std::size_t k = 0; k < static_cast<std::size_t>(e.size); ++k)
          EXPECT_EQ(at.emplace(e.corner[k], e.vertex[k]).first->second, e.vertex[k]);
        EXPECT_GT(VectorArea(e.Vertices()).dot(patch.normal), 0.999999 * e.area) << "turned over";
        if (e.IsLeaf()) {
          area += e.area;
          return;
        }
        const auto quarters = Quarters(e);
        for (ElementId c = 0; c < 4; ++c)
          for (std::size_t k = 0; k < static_cast<std::size_t>(e.size); ++k)
            EXPECT_LE((quarters[static_cast<std::size_t>(c)][k] - forest[e.first_child + c].vertex[k]).norm(),
                      1e-14 * (1 + patch.extent));
      });
      EXPECT_NEAR(area, patch.area, 1e-12);
    }
    forest.Validate();
  }
}

// After Balance() no leaf has a neighbour across an edge that is two levels finer: no corner of any leaf lies
// on another's edge but at its ends and its middle. Decided by brute force over all pairs, in integers.
TEST(ElementForest, BalanceLeavesNoTwoLevels) {
  Random random(402);
  std::size_t split = 0;
  for (int round = 0; round < 30; ++round) {
    const Scene scene = SomePatches(random);
    ElementForest forest(scene);
    for (PatchId p = 0; p < 4; ++p) {
      SplitAtRandom(forest, p, random, 40);
      split += forest.Balance(p);
      EXPECT_EQ(forest.Balance(p), 0U) << "twice is once";
      const std::vector<ElementId> leaves = forest.Leaves(p);
      for (const ElementId a : leaves)
        for (std::size_t k = 0; k < static_cast<std::size_t>(forest[a].size); ++k) {
          const LatticePoint from = forest[a].corner[k],
                             to = forest[a].corner[(k + 1) % static_cast<std::size_t>(forest[a].size)];
          const std::int64_t dx = to.x - from.x, dy = to.y - from.y;
          for (const ElementId b : leaves)
            for (const LatticePoint& c : forest[b].Corners()) {
              const std::int64_t cx = c.x - from.x, cy = c.y - from.y, along = cx * dx + cy * dy;
              if (cx * dy != cy * dx || along <= 0 || along >= dx * dx + dy * dy) continue;
              EXPECT_EQ(c, Midpoint(from, to));
            }
        }
    }
    forest.Validate();
  }
  EXPECT_GT(split, 0U);
}

// Trees that go down to the finest level of the lattice in one corner can be balanced.
TEST(ElementForest, BalanceAtTheFinestLevel) {
  Random random(403);
  const Scene scene = SomePatches(random);
  for (PatchId p = 0; p < 2; ++p) {
    ElementForest forest(scene);
    ElementId id = ElementForest::Root(p);
    for (int level = 0; level < kMaxLevel; ++level) id = forest.Subdivide(id) + (level == 0 ? 2 : 0);
    EXPECT_EQ(forest[id].level, kMaxLevel);
    forest.Balance(p);
    forest.Validate();
    for (const ElementId leaf : forest.Leaves(p)) EXPECT_LE(forest[leaf].level, kMaxLevel);
  }
}

}  // namespace
}  // namespace penumbra::scene_test
