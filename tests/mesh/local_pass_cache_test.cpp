// What the local pass keeps from one time to the next: geometric factors of weights, and leaves whose lines
// have not changed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "mesh/refinement/local_pass.h"
#include "mesh_test_scenes.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/transport/solvers/hierarchical_solver.h"

namespace penumbra {
namespace {

using mesh_test::RefineAtRandom;

bool Same(const std::vector<Discontinuity>& a, const std::vector<Discontinuity>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const Discontinuity& d, const Discontinuity& e) {
        const auto same_jump = [](const IrradianceJump& j, const IrradianceJump& k) {
          return j.gradient == k.gradient && j.curvature == k.curvature &&
                 j.largest_gradient == k.largest_gradient && j.largest_value == k.largest_value;
        };
        return d.end == e.end && d.kind == e.kind && d.degree == e.degree && d.receiver == e.receiver &&
               d.source == e.source && d.blocker == e.blocker && d.source_part == e.source_part &&
               d.blocker_part == e.blocker_part && d.geometric_weight == e.geometric_weight &&
               d.strength == e.strength && d.weight == e.weight &&
               std::equal(d.jump.begin(), d.jump.end(), e.jump.begin(), same_jump);
      });
}

// However the sources' strengths change, the cache gives what the finder gives; what has been traced is
// traced again only where a source has grown twice as bright.
TEST(DiscontinuityCache, KeepsGeometricFactors) {
  const Scene scene = *LoadBuiltinScene("floating-cube", {});
  const PatchVisibility visibility(scene);
  const DiscontinuityFinder finder(scene, visibility);
  const auto count = static_cast<PatchId>(scene.patches.size());
  for (const DiscontinuityWeight weight : {DiscontinuityWeight::kThesis, DiscontinuityWeight::kIrradiance}) {
    DiscontinuityCache cache(scene, visibility);
    DiscontinuityOptions options;
    options.weight = weight;
    options.min_weight = weight == DiscontinuityWeight::kThesis ? 5 : 0.05;
    Random random(3);
    std::vector<double> strength;
    for (PatchId p = 0; p < count; ++p)
      strength.push_back(10 + scene.materials[scene.patches[p].material].emittance.maxCoeff());
    std::size_t found = 0, pairs = 0;
    // Traced by the end of each round.
    std::vector<std::size_t> traced;
    const std::vector<double> factor = {1, 1, 0.3, 1.9, 0, 5, 1};
    for (const double f : factor) {
      std::vector<double> today = strength;
      for (double& s : today) s *= f;
      pairs = 0;
      for (PatchId p = 0; p < count; ++p) {
        const std::vector<Discontinuity> cached = cache.Find(p, today, options);
        EXPECT_TRUE(Same(cached, finder.Find(p, today, options))) << "factor " << f << ", patch " << p;
        found += cached.size();
        pairs += visibility.SourcesOf(p).size();
      }
      traced.push_back(cache.counts().traced);
    }
    EXPECT_GT(found, 100U);
    EXPECT_EQ(traced[0], pairs);
    EXPECT_EQ(traced[3], traced[0]) << "nothing has more than doubled";
    EXPECT_EQ(traced[4], traced[0]);
    EXPECT_GT(traced[5], traced[0]);
    EXPECT_EQ(traced[6], traced[5]);
    // Another option drops what was known.
    options.keep_hidden = true;
    EXPECT_TRUE(Same(cache.Find(0, strength, options), finder.Find(0, strength, options)));
  }
}

struct Office {
  Office() : scene(*LoadBuiltinScene("office", {})), visibility(scene) {
    SolverOptions options;
    options.eps = 30;
    options.min_area = 0.01;
    HierarchicalSolver solver(scene, visibility, options);
    solver.Iterate({});
    solution = solver.solution();
    mesh.weight = DiscontinuityWeight::kIrradiance;
    mesh.min_weight = 0.15;
    mesh.crowded_splits = 2;
  }

  std::vector<PatchTriangulation> Triangulate(const ElementForest& forest, MeshReport& report,
                                              LocalPassCache* cache) const {
    report = {};
    return PatchTriangulator(visibility, solution, mesh, {}, cache).Triangulate({forest, {}}, report);
  }

  Scene scene;
  PatchVisibility visibility;
  RadiositySolution solution;
  DiscontinuityOptions mesh;
};

void ExpectSame(const std::vector<PatchTriangulation>& a, const std::vector<PatchTriangulation>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t p = 0; p < a.size(); ++p) {
    EXPECT_EQ(a[p].positions, b[p].positions) << p;
    EXPECT_EQ(a[p].leaves, b[p].leaves) << p;
    EXPECT_EQ(a[p].first_triangle, b[p].first_triangle) << p;
    ASSERT_EQ(a[p].triangles.size(), b[p].triangles.size()) << p;
    for (std::size_t t = 0; t < a[p].triangles.size(); ++t) {
      EXPECT_EQ(a[p].triangles[t].vertex, b[p].triangles[t].vertex);
      EXPECT_EQ(a[p].triangles[t].line, b[p].triangles[t].line);
      EXPECT_EQ(a[p].triangles[t].contact, b[p].triangles[t].contact);
    }
  }
}

// Only leaves whose border or lines have changed are triangulated: none the second time, few when one leaf is
// divided, a part when a source fades. The meshes are those that are made without a cache, to the byte.
TEST(LocalPassCache, OnlyChangedLeavesAreTriangulated) {
  Office solved;
  ElementForest forest = solved.solution.forest;
  Random random(8);
  const auto count = static_cast<PatchId>(solved.scene.patches.size());
  for (PatchId p = 0; p < count; ++p) RefineAtRandom(forest, p, random, 15, 5);
  LocalPassCache cache(solved.scene, solved.visibility);
  MeshReport report, anew;
  solved.Triangulate(forest, report, &cache);
  const MeshReport::Counts first = report.counts;
  EXPECT_GT(first.leaves_made, 150U);
  EXPECT_EQ(first.leaves_kept, 0U);
  EXPECT_GT(first.pairs_traced, 500U);

  ExpectSame(solved.Triangulate(forest, report, &cache), solved.Triangulate(forest, anew, nullptr));
  EXPECT_EQ(report.counts.leaves_made, 0U);
  EXPECT_EQ(report.counts.leaves_kept, first.leaves_made);
  EXPECT_EQ(report.counts.pairs_traced, 0U);
  EXPECT_EQ(report.counts.pairs_kept, first.pairs_traced);
  EXPECT_EQ(anew.counts.leaves_made, first.leaves_made);

  // A leaf of the largest patch.
  PatchId largest = 0;
  for (PatchId p = 0; p < count; ++p)
    if (solved.scene.patches[p].area > solved.scene.patches[largest].area) largest = p;
  forest.Subdivide(forest.Leaves(largest).back());
  forest.Balance(largest);
  ExpectSame(solved.Triangulate(forest, report, &cache), solved.Triangulate(forest, anew, nullptr));
  EXPECT_GT(report.counts.leaves_made, 0U);
  EXPECT_LT(report.counts.leaves_made, first.leaves_made / 10);
  EXPECT_EQ(report.counts.leaves_made + report.counts.leaves_kept, anew.counts.leaves_made);
  std::printf("of %zu leaves with lines %zu are made when a leaf is divided", anew.counts.leaves_made,
              report.counts.leaves_made);

  // The reflectors fade: radiometric factors change, geometric ones do not.
  for (std::size_t i = 0; i < solved.solution.radiosity.size(); ++i) {
    const Patch& patch = solved.scene.patches[solved.solution.forest[static_cast<ElementId>(i)].patch];
    if ((solved.scene.materials[patch.material].emittance == 0).all()) solved.solution.radiosity[i] *= 0.3;
  }
  ExpectSame(solved.Triangulate(forest, report, &cache), solved.Triangulate(forest, anew, nullptr));
  EXPECT_EQ(report.counts.pairs_traced, 0U);
  EXPECT_GT(report.counts.leaves_made, 0U);
  EXPECT_LT(report.counts.leaves_made, first.leaves_made);
  EXPECT_GT(report.counts.leaves_kept, 0U);
  std::printf(", and of %zu, %zu when the reflectors fade\n", anew.counts.leaves_made,
              report.counts.leaves_made);
}

}  // namespace
}  // namespace penumbra
