// The oracle that looks at sizes alone.

#include <gtest/gtest.h>

#include "solver/transport/links/refinement_oracles.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra::scene_test {
namespace {

// Every link that is left has ends that are small beside its length, or that may not be split.
TEST(SizeOracle, LinksAreLong) {
  constexpr double kMinArea = 0.02, kLargestOfDistance = 0.25;
  Scene scene;
  AddMaterial(scene, 0.5, 3);
  AddBox(scene, Vec3::Zero(), Vec3::Ones(), true, 0);
  const PatchVisibility visibility(scene);
  SolverOptions options;
  options.oracle = "size";
  options.min_area = kMinArea;
  options.max_corrections = 0;
  HierarchicalSolver solver(scene, visibility, options);
  solver.Solve({});
  const ElementForest& forest = solver.solution().forest;
  EXPECT_GT(forest.size(), 6U);
  for (const Link& link : solver.solution().links.links) {
    const Element &receiver = forest[link.receiver], &source = forest[link.source];
    const double distance = (Centroid(receiver.Vertices()) - Centroid(source.Vertices())).norm();
    for (const Element* end : {&receiver, &source})
      EXPECT_TRUE(Diameter(end->Vertices()) <= kLargestOfDistance * distance || !MaySplit(*end, kMinArea));
  }
}

}  // namespace
}  // namespace penumbra::scene_test
