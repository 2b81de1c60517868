// How dark it is in places of a leaf, and what that is good for.

#include "mesh/interpolants/leaf_irradiance_samples.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdio>

#include "mesh/interpolants/representation_error.h"
#include "mesh/pipeline/pipeline.h"
#include "mesh/refinement/local_pass.h"
#include "mesh_test_scenes.h"
#include "solver/base/random.h"
#include "solver/scene/builtin_scenes.h"

namespace penumbra {
namespace {

// Linear light is told as it is all over leaves of any shape, from samples that neighbours share, and nobody
// is asked for more than the points that the leaves have.
TEST(LeafIrradianceSamples, IsExactForLinearLight) {
  Scene scene = mesh_test::EmptyScene();
  mesh_test::AddPatch(scene, {{0, 0, 1}, {4, 0, 1}, {3, 1, 1}, {0.5, 1.5, 1}});
  mesh_test::AddPatch(scene, {{0, 0, 2}, {5, 0, 2}, {1, 0.1, 2}});
  ElementForest forest(scene);
  for (const PatchId patch : {0, 1}) forest.Subdivide(ElementForest::Root(patch));
  const auto truth = [](const Vec3& p) { return Rgb(1 + p.x(), 9 - p.y(), p.x() + 2 * p.y()); };
  const IrradianceSampler sampler = [&](PatchId, const ReceiverPoint& at) {
    return PointIrradianceResult{truth(at.position), false};
  };
  std::size_t evaluations = 0;
  Random random(1, 1);
  double largest = 0;
  for (const PatchId patch : {0, 1}) {
    LeafIrradianceSamples light(forest, patch, sampler);
    for (const ElementId leaf : forest.Leaves(patch))
      for (int i = 0; i < 1000; ++i) {
        // Corners weighed at random: inside, as leaves are convex.
        Vec3 place = Vec3::Zero();
        double total = 0;
        for (const Vec3& corner : forest[leaf].Vertices()) {
          const double weight = random.Uniform();
          place += weight * corner;
          total += weight;
        }
        place /= total;
        largest = std::max(largest, (light.At(leaf, place) - truth(place)).abs().maxCoeff());
      }
    evaluations += light.evaluations();
  }
  constexpr double kRounding = 1e-13;  // a few sums of numbers up to 9
  EXPECT_LE(largest, kRounding);
  EXPECT_EQ(evaluations, 25U + 15U);  // lattices of two levels
}

// With few edges a leaf it matters which lie in the dark: on the floating cube with five a leaf the errors
// (root mean square) are a fifth of what they are where errors count beside the mean of the leaf. Bound: two
// thirds.
TEST(LeafIrradianceSamples, TellsWhichEdgesLieInTheDark) {
  const Scene scene = *LoadBuiltinScene("floating-cube", {});
  PipelineOptions options;
  options.error = 0.05;
  Pipeline pipeline(scene, options);
  pipeline.Solve({});
  pipeline.irradiance();  // is made once
  std::atomic<std::size_t> calls = 0;
  const auto sampler = [&](PatchId patch, const ReceiverPoint& at) {
    ++calls;
    return pipeline.irradiance().OnPatch(patch, at);
  };
  MeshOptions mesh_options;
  mesh_options.discontinuities.weight = DiscontinuityWeight::kIrradiance;
  mesh_options.discontinuities.min_weight = 0.01;
  mesh_options.discontinuities.max_leaf_dsets = 5;
  const auto rms = [&](const IrradianceMesh& mesh) {
    constexpr std::size_t kPoints = 4000;
    return MeasureRepresentationError(scene, mesh, sampler, kPoints, 1).rms;
  };
  const MeshResult seen = RunLocalPass(pipeline.visibility(), pipeline.solution(), sampler, mesh_options, {});
  EXPECT_EQ(seen.report.counts.point_evaluations, calls);
  MeshReport report;
  const IrradianceMesh unseen =
      BuildIrradianceMesh(
          scene,
          PatchTriangulator(pipeline.visibility(), pipeline.solution(), mesh_options.discontinuities, {})
              .Triangulate(seen.plan, report),
          InterpolantOrder::kQuadratic, sampler, {})
          .mesh;
  const double with = rms(seen.mesh), without = rms(unseen);
  std::printf("rms %.3g, %.3g beside the mean of the leaf\n", with, without);
  EXPECT_LE(with, 2.0 / 3 * without);
}

}  // namespace
}  // namespace penumbra
