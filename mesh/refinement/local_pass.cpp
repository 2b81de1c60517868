#include "mesh/refinement/local_pass.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "mesh/discontinuities/contact_corners.h"
#include "mesh/discontinuities/discontinuity_choices.h"
#include "mesh/discontinuities/dset.h"
#include "mesh/interpolants/leaf_light.h"
#include "mesh/interpolants/light_beside.h"
#include "mesh/triangulation/weld.h"
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

namespace {

PatchDSets Activate(const ElementForest& forest, const PatchVisibility& visibility, PatchId patch,
                    std::span<const Discontinuity> found, const DiscontinuityOptions& options,
                    const LightBeside& light, LeafLight* places = nullptr) {
  const auto scale = [&](ElementId leaf) { return light.ScaleOf(forest, leaf); };
  PlaceScale at_place;
  if (places) {
    const Frame frame = PolygonFrame(forest.scene().patches[static_cast<std::size_t>(patch)].Vertices());
    at_place = [&light, places, frame](ElementId leaf, const Vec2& place) {
      return light.ScaleIn(places->At(leaf, frame.FromPlane(place)));
    };
  }
  const LeafFilter filter = DiscontinuityChoices().Make(options.choice)->FilterOf(forest, visibility, patch);
  return ActivateDiscontinuities(forest, patch, found, options, filter, scale, at_place);
}

// The discontinuities on the patch that may become edges, those of the plan marked.
std::vector<Discontinuity> FindOnPatch(PatchId patch, std::span<const double> strength,
                                       const LightBeside& light, const MeshPlan& plan,
                                       const DiscontinuityOptions& options, LocalPassCache* cache,
                                       const ExecutionContext& context) {
  std::vector<Discontinuity> found =
      cache->discontinuities.Find(patch, strength, light.ToFindOn(patch, options), context);
  if (static_cast<std::size_t>(patch) >= plan.wanted.size()) return found;
  for (const Discontinuity& wanted : plan.wanted[static_cast<std::size_t>(patch)])
    for (Discontinuity& d : found) d.wanted |= SameTrace(d, wanted);
  return found;
}

// Splits the crowded leaves of the patch, and what balance asks for. Returns how many were crowded.
std::size_t SplitCrowded(ElementForest& forest, PatchId patch, std::span<const ElementId> crowded,
                         double min_area) {
  std::size_t split = 0;
  for (const ElementId leaf : crowded) {
    constexpr int kChildren = 4;
    if (forest[leaf].level >= kMaxLevel || forest[leaf].area < kChildren * min_area) continue;
    forest.Subdivide(leaf);
    ++split;
  }
  if (split > 0) forest.Balance(patch);
  return split;
}

}  // namespace

MeshPlan BeginPlan(const PatchVisibility& visibility, const RadiositySolution& solution,
                   const DiscontinuityOptions& options) {
  MeshPlan plan = {solution.forest, {}};
  if (!options.enabled() || options.corner_divisions == 0) return plan;
  const Scene& scene = solution.forest.scene();
  const DiscontinuityFinder finder(scene, visibility);
  for (PatchId p = 0; p < static_cast<PatchId>(scene.patches.size()); ++p)
    DivideTowards(ContactEnds(scene.patches[static_cast<std::size_t>(p)], finder.FindContacts(p, options)),
                  options.corner_divisions, options.min_split_area, p, plan.forest);
  return plan;
}

std::vector<PatchTriangulation> TriangulatePatches(
    const PatchVisibility& visibility, const RadiositySolution& solution, const MeshPlan& plan,
    const DiscontinuityOptions& options, const ExecutionContext& context, MeshReport& report,
    LocalPassCache* cache, std::vector<OmittedOfPatch>* omitted, const IrradianceSampler& sampler) {
  const Scene& scene = solution.forest.scene();
  const std::size_t count = scene.patches.size();
  if (omitted) omitted->clear();

  context.Report("discontinuities", 0);
  Stopwatch finding;
  std::vector<PatchDSets> dsets(count);
  std::vector<std::vector<Discontinuity>> found(count);
  const LightBeside light(solution, options.weight);
  const std::vector<double> strength = SourceStrengths(solution);
  std::optional<LocalPassCache> own;
  if (!cache) cache = &own.emplace(scene, visibility);
  const DiscontinuityCache::Counts before = cache->discontinuities.counts();
  ParallelFor(count, 1, [&](std::size_t p) {
    if (options.enabled() && !context.Cancelled())
      found[p] = FindOnPatch(static_cast<PatchId>(p), strength, light, plan, options, cache, context);
  });
  report.counts.pairs_traced += cache->discontinuities.counts().traced - before.traced;
  report.counts.pairs_kept += cache->discontinuities.counts().kept - before.kept;
  DiscontinuityOptions activating = options;
  if (!omitted) activating.min_wanted_weight = activating.min_weight;  // nobody asks what was left out
  // Crowded leaves are split in quadtrees of the mesh's own.
  ElementForest forest = plan.forest;
  std::vector<std::size_t> patches_to_do(count);
  std::iota(patches_to_do.begin(), patches_to_do.end(), std::size_t{0});
  for (int round = 0; !patches_to_do.empty() && !context.Cancelled(); ++round) {
    ParallelFor(patches_to_do.size(), 1, [&](std::size_t i) {
      if (context.Cancelled()) return;
      const std::size_t p = patches_to_do[i];
      dsets[p] = Activate(forest, visibility, static_cast<PatchId>(p), found[p], activating, light);
    });
    if (round == options.crowded_splits) break;
    std::vector<std::size_t> again;
    for (const std::size_t p : patches_to_do) {
      const std::size_t split =
          SplitCrowded(forest, static_cast<PatchId>(p), dsets[p].crowded, options.min_split_area);
      report.counts.leaves_split += split;
      if (split > 0) again.push_back(p);
    }
    patches_to_do.swap(again);
  }
  // Where some were refused, it matters which: those in the dark count most.
  if (sampler && activating.ranks_by_error()) {
    std::vector<std::size_t> evaluations(count);
    ParallelFor(count, 1, [&](std::size_t p) {
      if (dsets[p].refused == 0 || context.Cancelled()) return;
      LeafLight places(forest, static_cast<PatchId>(p), sampler);
      dsets[p] = Activate(forest, visibility, static_cast<PatchId>(p), found[p], activating, light, &places);
      evaluations[p] = places.evaluations();
    });
    report.counts.point_evaluations +=
        std::accumulate(evaluations.begin(), evaluations.end(), std::size_t{0});
  }
  report.seconds.discontinuities += finding.Seconds();

  Stopwatch triangulating;
  std::vector<PatchTriangulation> patches(count);
  std::vector<PatchBorders> borders;
  context.Report("triangulate", 0);
  if (!context.Cancelled()) {
    borders.resize(count);
    ParallelFor(count, 1, [&](std::size_t p) {
      if (!context.Cancelled()) borders[p] = PatchBorders(forest, static_cast<PatchId>(p), dsets[p]);
    });
    if (!context.Cancelled()) WeldOutlines(scene, borders);
    ParallelFor(count, 1, [&](std::size_t p) {
      if (context.Cancelled()) return;
      patches[p] = TriangulateLeaves(forest, static_cast<PatchId>(p), dsets[p], std::move(borders[p]),
                                     own ? nullptr : &cache->leaves[p]);
    });
  }
  for (std::size_t p = 0; p < count && !context.Cancelled(); ++p) {
    for (ElementId& leaf : patches[p].leaves)
      while (static_cast<std::size_t>(leaf) >= plan.forest.size()) leaf = forest[leaf].parent;
    const double scale = light.LargestScale(static_cast<PatchId>(p));
    for (const Discontinuity& d : found[p])
      if (d.wanted || scale * d.weight >= options.min_weight) ++report.counts.discontinuities;
    report.counts.activated += dsets[p].activated;
    report.counts.dsets_active += dsets[p].dsets_active;
    report.counts.refused += dsets[p].refused;
    report.counts.refused_contacts += dsets[p].refused_contacts;
    report.counts.most_merged = std::max(report.counts.most_merged, dsets[p].most_merged);
    report.counts.dropped_segments += patches[p].dropped_segments;
    report.counts.leaves_made += patches[p].leaves_made;
    report.counts.leaves_kept += patches[p].leaves_kept;
    report.counts.triangles += patches[p].triangles.size();
    if (omitted) omitted->push_back({std::move(found[p]), std::move(dsets[p].omitted)});
  }
  report.seconds.triangulate += triangulating.Seconds();
  return patches;
}

MeshResult RunLocalPass(const PatchVisibility& visibility, const RadiositySolution& solution,
                        const IrradianceSampler& sampler, const MeshOptions& options,
                        const ExecutionContext& context, LocalPassCache* cache) {
  MeshResult result;
  result.plan = BeginPlan(visibility, solution, options.discontinuities);
  const bool constant = options.order == InterpolantOrder::kConstant;
  result.triangulations =
      TriangulatePatches(visibility, solution, result.plan, options.discontinuities, context, result.report,
                         cache, nullptr, constant ? IrradianceSampler() : sampler);
  if (context.Cancelled()) return result;
  const std::vector<PatchTriangulation>& patches = result.triangulations;
  Stopwatch interpolating;
  if (constant) {
    result.mesh = BuildConstantMesh(patches, solution.irradiance);
  } else {
    BuiltMesh built = BuildIrradianceMesh(solution.forest.scene(), patches, options.order, sampler, context);
    result.report.counts.point_evaluations += built.point_evaluations;
    if (context.Cancelled()) return result;
    result.mesh = std::move(built.mesh);
  }
  result.report.counts.interpolants = result.mesh.irradiance.size();
  result.report.seconds.interpolate = interpolating.Seconds();
  return result;
}

}  // namespace penumbra
