#include "mesh/refinement/local_pass.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "mesh/discontinuities/contact_corners.h"
#include "mesh/discontinuities/discontinuity_choices.h"
#include "mesh/discontinuities/dset.h"
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

// Splits the crowded leaves of the patch, and balances its quadtree. Returns the number of crowded leaves
// that were split.
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

namespace {

constexpr ElementId kQuarters = 4;  // children of an element

}  // namespace

// The data of one call of Triangulate().
struct PatchTriangulator::Work {
  const MeshPlan& plan;
  MeshReport& report;
  DiscontinuityOptions activating;
  bool lists_omitted;    // the caller needs the omitted discontinuities
  ElementForest forest;  // the plan's forest, in which crowded leaves are split for the mesh only
  std::vector<std::vector<Discontinuity>> found;  // by patch
  std::vector<PatchDSets> dsets;                  // by patch
  std::vector<char> is_known;                     // by patch: dsets are those of an earlier call
};

PatchTriangulator::PatchTriangulator(const PatchVisibility& visibility, const RadiositySolution& solution,
                                     const DiscontinuityOptions& options, const ExecutionContext& context,
                                     LocalPassCache* cache)
    : visibility_(visibility),
      solution_(solution),
      options_(options),
      context_(context),
      cache_(cache ? *cache : own_cache_.emplace(solution.forest.scene(), visibility)),
      light_(solution, options.weight),
      strength_(SourceStrengths(solution)) {}

// The discontinuities on the patch that may become edges, with those of the plan marked as wanted.
std::vector<Discontinuity> PatchTriangulator::FindOn(PatchId patch, const MeshPlan& plan) const {
  std::vector<Discontinuity> found =
      cache_.discontinuities.Find(patch, strength_, light_.ToFindOn(patch, options_), context_);
  if (static_cast<std::size_t>(patch) >= plan.wanted.size()) return found;
  for (const Discontinuity& wanted : plan.wanted[static_cast<std::size_t>(patch)])
    for (Discontinuity& d : found) d.wanted |= SameTrace(d, wanted);
  return found;
}

void PatchTriangulator::FindAll(Work& work) const {
  const DiscontinuityCache::Counts before = cache_.discontinuities.counts();
  ParallelFor(work.found.size(), 1, [&](std::size_t p) {
    if (options_.enabled() && !context_.Cancelled())
      work.found[p] = FindOn(static_cast<PatchId>(p), work.plan);
  });
  work.report.counts.pairs_traced += cache_.discontinuities.counts().traced - before.traced;
  work.report.counts.pairs_kept += cache_.discontinuities.counts().kept - before.kept;
}

PatchDSets PatchTriangulator::Activate(const Work& work, std::size_t p, LeafIrradianceSamples* places) const {
  const auto patch = static_cast<PatchId>(p);
  const ElementForest& forest = work.forest;
  const auto scale = [&](ElementId leaf) { return light_.ScaleOf(forest, leaf); };
  PlaceScale at_place;
  if (places) {
    const Frame frame = PolygonFrame(forest.scene().patches[p].Vertices());
    at_place = [this, places, frame](ElementId leaf, const Vec2& place) {
      return light_.ScaleIn(places->At(leaf, frame.FromPlane(place)));
    };
  }
  const LeafFilter filter =
      DiscontinuityChoices().Make(options_.choice)->FilterOf(forest, visibility_, patch);
  return ActivateDiscontinuities(forest, patch, work.found[p], work.activating, {filter, scale, at_place});
}

namespace {

std::size_t WantedOn(const MeshPlan& plan, std::size_t patch) {
  return patch < plan.wanted.size() ? plan.wanted[patch].size() : 0;
}

}  // namespace

// Takes over the activations of earlier calls for patches whose plan is the same.
void PatchTriangulator::RecallActivations(Work& work) const {
  work.is_known.assign(work.dsets.size(), 0);
  for (std::size_t p = 0; p < activations_.size(); ++p) {
    const Activation& last = activations_[p];
    if (last.leaves.empty() || last.lists_omitted != work.lists_omitted ||
        last.wanted != WantedOn(work.plan, p) ||
        last.leaves != work.plan.forest.Leaves(static_cast<PatchId>(p)))
      continue;
    // The same splits, whose children have other numbers now.
    std::unordered_map<ElementId, ElementId> now;
    const auto number = [&](ElementId then) {
      const auto found = now.find(then);
      return found == now.end() ? then : found->second;
    };
    for (const auto& [element, first_child] : last.splits) {
      const ElementId parent = number(element);
      work.forest.Subdivide(parent);
      for (ElementId k = 0; k < kQuarters; ++k) now[first_child + k] = work.forest[parent].first_child + k;
    }
    work.dsets[p] = last.dsets;
    for (ElementId& leaf : work.dsets[p].leaves) leaf = number(leaf);
    for (ElementId& leaf : work.dsets[p].crowded) leaf = number(leaf);
    work.is_known[p] = 1;
  }
}

void PatchTriangulator::KeepActivations(const Work& work) {
  activations_.resize(work.dsets.size());
  std::vector<std::vector<std::pair<ElementId, ElementId>>> splits(work.dsets.size());
  for (auto id = static_cast<ElementId>(work.plan.forest.size());
       id < static_cast<ElementId>(work.forest.size()); id += kQuarters)
    splits[static_cast<std::size_t>(work.forest[id].patch)].emplace_back(work.forest[id].parent, id);
  for (std::size_t p = 0; p < work.dsets.size(); ++p)
    if (!work.is_known[p])
      activations_[p] = {work.plan.forest.Leaves(static_cast<PatchId>(p)), WantedOn(work.plan, p),
                         work.lists_omitted, std::move(splits[p]), work.dsets[p]};
}

// Activates on all patches, and again on patches where crowded leaves were split.
void PatchTriangulator::ActivateAll(Work& work) const {
  std::vector<std::size_t> patches_to_do;
  for (std::size_t p = 0; p < work.dsets.size(); ++p)
    if (!work.is_known[p]) patches_to_do.push_back(p);
  for (int round = 0; !patches_to_do.empty() && !context_.Cancelled(); ++round) {
    ParallelFor(patches_to_do.size(), 1, [&](std::size_t i) {
      if (context_.Cancelled()) return;
      work.dsets[patches_to_do[i]] = Activate(work, patches_to_do[i]);
    });
    if (round == options_.crowded_splits) break;
    std::vector<std::size_t> again;
    for (const std::size_t p : patches_to_do) {
      const std::size_t split =
          SplitCrowded(work.forest, static_cast<PatchId>(p), work.dsets[p].crowded, options_.min_split_area);
      work.report.counts.leaves_split += split;
      if (split > 0) again.push_back(p);
    }
    patches_to_do.swap(again);
  }
}

// Repeats the activation where discontinuities were refused, now with the irradiance at their places: those
// in the dark count most.
void PatchTriangulator::ActivateByPlaces(Work& work) const {
  if (!sampler_ || sampler_->empty() || !work.activating.ranks_by_error()) return;
  std::vector<std::size_t> evaluations(work.dsets.size());
  std::vector<SampleCache> taken(work.dsets.size());
  ParallelFor(work.dsets.size(), 1, [&](std::size_t p) {
    if (work.is_known[p] || work.dsets[p].refused == 0 || context_.Cancelled()) return;
    LeafIrradianceSamples places(work.forest, static_cast<PatchId>(p), *sampler_, samples_);
    work.dsets[p] = Activate(work, p, &places);
    evaluations[p] = places.evaluations();
    taken[p] = std::move(places).TakeSamples();
  });
  if (samples_ && !context_.Cancelled())
    for (SampleCache& samples : taken) samples_->Merge(std::move(samples));
  work.report.counts.point_evaluations +=
      std::accumulate(evaluations.begin(), evaluations.end(), std::size_t{0});
}

std::vector<PatchTriangulation> PatchTriangulator::TriangulateAll(const Work& work) const {
  const std::size_t count = work.dsets.size();
  std::vector<PatchTriangulation> patches(count);
  if (context_.Cancelled()) return patches;
  std::vector<PatchBorders> borders(count);
  ParallelFor(count, 1, [&](std::size_t p) {
    if (!context_.Cancelled()) borders[p] = PatchBorders(work.forest, static_cast<PatchId>(p), work.dsets[p]);
  });
  if (!context_.Cancelled()) WeldOutlines(work.forest.scene(), borders, context_);
  ParallelFor(count, 1, [&](std::size_t p) {
    if (context_.Cancelled()) return;
    patches[p] = TriangulateLeaves(work.forest, static_cast<PatchId>(p), work.dsets[p], std::move(borders[p]),
                                   own_cache_ ? nullptr : &cache_.leaves[p]);
  });
  return patches;
}

void PatchTriangulator::Count(const Work& work, const PatchTriangulation& triangulated,
                              std::size_t patch) const {
  MeshReport& report = work.report;
  const double scale = light_.LargestScale(static_cast<PatchId>(patch));
  for (const Discontinuity& d : work.found[patch])
    if (d.wanted || scale * d.weight >= options_.min_weight) ++report.counts.discontinuities;
  const PatchDSets& dsets = work.dsets[patch];
  report.counts.activated += dsets.activated;
  report.counts.dsets_active += dsets.dsets_active;
  report.counts.refused += dsets.refused;
  report.counts.refused_contacts += dsets.refused_contacts;
  report.counts.most_merged = std::max(report.counts.most_merged, dsets.most_merged);
  report.counts.dropped_segments += triangulated.dropped_segments;
  report.counts.leaves_made += triangulated.leaves_made;
  report.counts.leaves_kept += triangulated.leaves_kept;
  report.counts.triangles += triangulated.triangles.size();
}

std::vector<PatchTriangulation> PatchTriangulator::Triangulate(const MeshPlan& plan, MeshReport& report,
                                                               std::vector<OmittedOfPatch>* omitted) {
  const std::size_t count = solution_.forest.scene().patches.size();
  if (omitted) omitted->clear();
  context_.Report("discontinuities", 0);
  const Stopwatch finding;
  Work work{plan, report, options_, omitted != nullptr, plan.forest, {}, {}, {}};
  work.found.resize(count);
  work.dsets.resize(count);
  if (!omitted) work.activating.min_wanted_weight = options_.min_weight;  // no caller needs the omitted ones
  FindAll(work);
  RecallActivations(work);
  ActivateAll(work);
  ActivateByPlaces(work);
  if (!context_.Cancelled()) KeepActivations(work);
  report.seconds.discontinuities += finding.Seconds();

  const Stopwatch triangulating;
  context_.Report("triangulate", 0);
  std::vector<PatchTriangulation> patches = TriangulateAll(work);
  for (std::size_t p = 0; p < count && !context_.Cancelled(); ++p) {
    for (ElementId& leaf : patches[p].leaves)
      while (static_cast<std::size_t>(leaf) >= plan.forest.size()) leaf = work.forest[leaf].parent;
    Count(work, patches[p], p);
    if (omitted) omitted->push_back({std::move(work.found[p]), std::move(work.dsets[p].omitted)});
  }
  report.seconds.triangulate += triangulating.Seconds();
  return patches;
}

MeshResult RunLocalPass(const PatchVisibility& visibility, const RadiositySolution& solution,
                        const IrradianceSampler& sampler, const MeshOptions& options,
                        const ExecutionContext& context, const LocalPassMemory& memory) {
  MeshResult result;
  result.plan = BeginPlan(visibility, solution, options.discontinuities);
  const bool constant = options.order == InterpolantOrder::kConstant;
  PatchTriangulator triangulator(visibility, solution, options.discontinuities, context, memory.cache);
  if (!constant) triangulator.RankWith(sampler, memory.samples);
  result.triangulations = triangulator.Triangulate(result.plan, result.report);
  if (context.Cancelled()) return result;
  const std::vector<PatchTriangulation>& patches = result.triangulations;
  Stopwatch interpolating;
  if (constant) {
    result.mesh = BuildConstantMesh(patches, solution.irradiance);
  } else {
    BuiltMesh built = BuildIrradianceMesh(solution.forest.scene(), patches, {options.order, options.smooth},
                                          sampler, context, memory.samples);
    result.report.counts.point_evaluations += built.point_evaluations;
    if (context.Cancelled()) return result;
    result.mesh = std::move(built.mesh);
  }
  result.report.counts.interpolants = result.mesh.irradiance.size();
  result.report.seconds.interpolate = interpolating.Seconds();
  return result;
}

}  // namespace penumbra
