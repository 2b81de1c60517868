// What a source's subtrees tell of their leaves.

#include "solver/transport/sources/source_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/transport/links/solution.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra {
namespace {

constexpr int kLevels = 3;

// A wall of 4 m x 2 m, far from the origin and turned anyhow, in leaves whose radiosities rise along it as a
// plane does.
struct Wall {
  Wall(const Vec3& from, const Vec3& slope) {
    const Vec3 u = Vec3(2, 1, 2) / 3, v = Vec3(1, 2, -2) / 3;
    scene_test::AddMaterial(scene, 0.5, 0);
    scene_test::Add(scene, {from, from + 4 * u, from + 4 * u + 2 * v, from + 2 * v}, 0);
    solution.forest = ElementForest(scene);
    for (int level = 0; level < kLevels; ++level)
      for (const ElementId leaf : solution.forest.Leaves(0)) solution.forest.Subdivide(leaf);
    solution.radiosity.assign(solution.forest.size(), Rgb::Zero());
    centre = from + 2 * u + v;
    along = slope.dot(u) * u + slope.dot(v) * v;
    for (const ElementId leaf : solution.forest.Leaves(0))
      solution.radiosity[static_cast<std::size_t>(leaf)] = At(Centroid(solution.forest[leaf].Vertices()));
    solution.radiosity[0].setConstant(1);  // sends light
  }
  Rgb At(const Vec3& place) const { return (5 + along.dot(place - centre)) * Rgb(1, 0.5, 0.25); }

  Scene scene;
  RadiositySolution solution;
  Vec3 centre, along;
};

// Radiosities that are constant on n x n leaves and lie in a plane at the centres: the nearest plane has the
// slope times 1 - 1 / n^2, since the steps have a flat part, and its residual is the spread over n. At every
// level and far from the origin.
TEST(SourceSet, SubtreesKnowTheSlopeOfTheirLeaves) {
  for (const double far : {0.0, 1e4}) {
    const Wall wall(Vec3(far, -far, 0.5 * far), {0.7, -0.4, 0.3});
    const SourceSet set = SourceSet::FromSolution(wall.solution);
    const double rounding = 1e-15 * std::max(1.0, far);  // of places, relative to the wall
    int subtrees = 0;
    for (const SourceSet::Node& node : set.Tree(0)) {
      if (node.skip == 1) {
        EXPECT_EQ(node.slope, Eigen::Matrix3d::Zero());
        continue;
      }
      ++subtrees;
      const Rgb channels(1, 0.5, 0.25);
      const double n = std::sqrt(node.leaf_count);
      const Eigen::Matrix3d want = (1 - 1 / (n * n)) * channels.matrix() * wall.along.transpose();
      EXPECT_LE((node.slope - want).norm(), 1e3 * rounding * (1 << kLevels)) << "level of " << node.skip;
      EXPECT_LE((node.radiosity - wall.At(node.centre)).abs().maxCoeff(), 1e3 * rounding);
      EXPECT_GT(node.spread, 0.01);
      EXPECT_NEAR(node.residual, node.spread / n, 10 * std::sqrt(1e3 * rounding));
    }
    EXPECT_EQ(subtrees, 1 + 4 + 16);
  }
}

// Corners that nodes share have one number, at every level and far from the origin.
TEST(SourceSet, NumbersEachCornerOnce) {
  for (const double far : {0.0, 1e4}) {
    const Wall wall(Vec3(far, -far, 0.5 * far), {0.7, -0.4, 0.3});
    const SourceSet set = SourceSet::FromSolution(wall.solution);
    EXPECT_EQ(set.Corners().size(), ((1 << kLevels) + 1) * ((1 << kLevels) + 1));
    for (const SourceSet::Node& node : set.Tree(0))
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_EQ(set.Corners()[static_cast<std::size_t>(node.corner[k])], node.vertex[k]);
  }
}

// With one leaf far off the plane the residual is what the best plane leaves, and more than nothing.
TEST(SourceSet, ResidualIsWhatThePlaneLeaves) {
  Wall wall(Vec3::Zero(), {0.7, -0.4, 0.3});
  wall.solution.radiosity[static_cast<std::size_t>(wall.solution.forest.Leaves(0)[5])] *= 2;
  const SourceSet set = SourceSet::FromSolution(wall.solution);
  const SourceSet::Node& root = set.Tree(0)[0];
  double residual = 0, spread = 0, area = 0;
  for (const SourceSet::Node& leaf : set.Tree(0)) {
    if (leaf.skip != 1) continue;
    const Rgb plane = root.radiosity + (root.slope * (leaf.centre - root.centre)).array();
    residual += leaf.area * std::pow(leaf.radiosity[0] - plane[0], 2);
    // Within the leaf, a parallelogram, the plane rises and the radiosity does not.
    for (const std::size_t k : {std::size_t{1}, std::size_t{3}})
      residual += leaf.area / 12 * std::pow(root.slope.row(0).dot(leaf.vertex[k] - leaf.vertex[0]), 2);
    spread += leaf.area * std::pow(leaf.radiosity[0] - root.radiosity[0], 2);
    area += leaf.area;
  }
  EXPECT_NEAR(root.residual, std::sqrt(residual / area) / root.radiosity[0], 1e-12);
  EXPECT_NEAR(root.spread, std::sqrt(spread / area) / root.radiosity[0], 1e-12);
  EXPECT_GT(root.residual, 0.05);
  EXPECT_LT(root.residual, root.spread);
}

// Leaves in a row tell nothing of the slope across it.
TEST(SourceSet, ANarrowWallHasASlopeAlongItAlone) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 0);
  scene_test::Add(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1e-7, 0}, {0, 1e-7, 0}}, 0);
  RadiositySolution solution;
  solution.forest = ElementForest(scene);
  solution.forest.Subdivide(0);
  solution.radiosity.assign(5, Rgb::Constant(1));
  for (const ElementId leaf : solution.forest.Leaves(0))
    solution.radiosity[static_cast<std::size_t>(leaf)].setConstant(
        1 + Centroid(solution.forest[leaf].Vertices()).x());
  const SourceSet::Node root = SourceSet::FromSolution(solution).Tree(0)[0];
  EXPECT_NEAR(root.slope(0, 0), 0.75, 1e-9);
  EXPECT_NEAR(root.slope(0, 1), 0, 1e-6);
}

// Pieces whose centroids lie nearly in a row say little of the slope across the row. A fit through the
// centroids alone would take rounding and small differences for a steep slope there.
TEST(SourceSet, PiecesInARowHaveNoSteepSlopeAcrossIt) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 0);
  scene_test::Add(scene, {{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 1, 0}}, 0);
  RadiositySolution solution;
  solution.forest = ElementForest(scene);
  solution.radiosity.assign(1, Rgb::Constant(1));
  for (const double tilt : {0.0, 1e-6, 1e-3, 0.1}) {
    std::vector<Fragment> fragments;
    double radiosity[] = {1, 1.02, 0.98, 1};
    for (int k = 0; k < 4; ++k) {
      const double from = k, to = k + 1, lean = k % 2 == 0 ? tilt : -tilt;
      Fragment fragment;
      fragment.leaf = 0;
      fragment.polygon = {{from + (k > 0 ? -lean : 0), 0, 0},
                          {to + (k < 3 ? lean : 0), 0, 0},
                          {to + (k < 3 ? -lean : 0), 1, 0},
                          {from + (k > 0 ? lean : 0), 1, 0}};
      fragment.area = VectorArea(fragment.polygon).norm();
      fragment.radiosity.setConstant(radiosity[k]);
      fragments.push_back(fragment);
    }
    const SourceSet::Node root = SourceSet::FromSolution(solution, fragments).Tree(0)[0];
    // Over half of the width of 1 the fit must not differ by more than the radiosities do.
    EXPECT_LE(std::abs(root.slope(0, 1)) * 0.5, 0.04) << tilt;
  }
}

// A fragment that is a whole leaf is that leaf with another radiosity, not a subtree of one, whose slope
// would be whatever rounding makes of it.
TEST(SourceSet, AFragmentThatIsAWholeLeafStandsForIt) {
  const double far = 1e4;
  const Wall wall(Vec3(far, -far, 0.5 * far), {0.7, -0.4, 0.3});
  std::vector<Fragment> fragments;
  for (const ElementId leaf : wall.solution.forest.Leaves(0)) {
    const Element& element = wall.solution.forest[leaf];
    Fragment fragment;
    fragment.leaf = leaf;
    fragment.polygon.assign(element.Vertices().begin(), element.Vertices().end());
    fragment.area = element.area;
    fragment.radiosity = 2 * wall.solution.radiosity[static_cast<std::size_t>(leaf)];
    fragments.push_back(fragment);
  }
  std::sort(fragments.begin(), fragments.end(),
            [](const Fragment& a, const Fragment& b) { return a.leaf < b.leaf; });
  const SourceSet plain = SourceSet::FromSolution(wall.solution),
                  other = SourceSet::FromSolution(wall.solution, fragments);
  ASSERT_EQ(other.Tree(0).size(), plain.Tree(0).size());
  for (std::size_t i = 0; i < plain.Tree(0).size(); ++i) {
    const SourceSet::Node &a = plain.Tree(0)[i], &b = other.Tree(0)[i];
    EXPECT_EQ(b.skip, a.skip);
    EXPECT_EQ(b.vertex, a.vertex);
    EXPECT_TRUE((b.radiosity == 2 * a.radiosity).all());
    EXPECT_EQ(b.slope, 2 * a.slope);
    EXPECT_EQ(b.fragment >= 0, b.skip == 1);
  }
}

}  // namespace
}  // namespace penumbra
