#include "mesh/local_pass.h"

#include <algorithm>

#include "mesh/discontinuity.h"
#include "mesh/dset.h"
#include "solver/base/parallel.h"
#include "solver/base/stopwatch.h"

namespace penumbra {
std::vector<double> SourceStrengths(const RadiositySolution& solution) {
  std::vector<double> strength(solution.forest.scene().patches.size(), 0.0);
  for (std::size_t i = 0; i < solution.forest.size(); ++i) {
    const Element& e = solution.forest.elements()[i];
    if (e.IsLeaf()) strength[e.patch] = std::max(strength[e.patch], solution.radiosity[i].maxCoeff());
  }
  return strength;
}

std::vector<PatchTriangulation> TriangulatePatches(const PatchVisibility& visibility,
                                                   const RadiositySolution& solution,
                                                   const DiscontinuityOptions& options,
                                                   const ExecutionContext& context, MeshReport& report) {
  const Scene& scene = solution.forest.scene();
  const std::size_t count = scene.patches.size();

  context.Report("discontinuities", 0);
  Stopwatch finding;
  std::vector<PatchDSets> dsets(count);
  std::vector<std::size_t> found_count(count, 0);
  const std::vector<double> strength = SourceStrengths(solution);
  const DiscontinuityFinder finder(scene, visibility);
  ParallelFor(count, 1, [&](std::size_t p) {
    if (context.Cancelled()) return;
    const auto patch = static_cast<PatchId>(p);
    std::vector<Discontinuity> found;
    if (options.enabled) found = finder.Find(patch, strength, options.min_weight);
    found_count[p] = found.size();
    dsets[p] = ActivateDiscontinuities(solution.forest, patch, found, options);
  });
  report.seconds.discontinuities += finding.Seconds();

  Stopwatch triangulating;
  std::vector<PatchTriangulation> patches(count);
  for (std::size_t p = 0; p < count && !context.Cancelled(); ++p) {
    context.Report("triangulate", static_cast<double>(p) / static_cast<double>(count));
    patches[p] = TriangulateLeaves(solution.forest, static_cast<PatchId>(p), dsets[p]);
    report.counts.discontinuities += found_count[p];
    report.counts.activated += dsets[p].activated;
    report.counts.dsets_active += dsets[p].dsets_active;
    report.counts.refused += dsets[p].refused;
    report.counts.refused_contacts += dsets[p].refused_contacts;
    report.counts.dropped_segments += patches[p].dropped_segments;
    report.counts.triangles += patches[p].triangles.size();
  }
  report.seconds.triangulate += triangulating.Seconds();
  return patches;
}

MeshResult RunLocalPass(const PatchVisibility& visibility, const RadiositySolution& solution,
                        const IrradianceSampler& sampler, const MeshOptions& options,
                        const ExecutionContext& context) {
  MeshResult result;
  const std::vector<PatchTriangulation> patches =
      TriangulatePatches(visibility, solution, options.discontinuities, context, result.report);
  if (context.Cancelled()) return result;
  Stopwatch interpolating;
  if (options.order == InterpolantOrder::kConstant) {
    result.mesh = BuildConstantMesh(patches, solution.irradiance);
  } else {
    BuiltMesh built = BuildIrradianceMesh(solution.forest.scene(), patches, options.order, sampler, context);
    result.report.counts.point_evaluations = built.point_evaluations;
    if (context.Cancelled()) return result;
    result.mesh = std::move(built.mesh);
  }
  result.report.counts.interpolants = result.mesh.irradiance.size();
  result.report.seconds.interpolate = interpolating.Seconds();
  return result;
}

}  // namespace penumbra
