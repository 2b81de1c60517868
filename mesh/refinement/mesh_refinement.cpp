#include "mesh/refinement/mesh_refinement.h"

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/interpolants/representation_error.h"
#include "mesh/refinement/refinement_step.h"
#include "solver/base/check.h"
#include "solver/base/stopwatch.h"
#include "solver/scene/scene_parts.h"
#include "solver/visibility/point/enclosure.h"

namespace penumbra {
namespace {

// Above this fraction, a triangle whose measured error is small is measured once more, at finer points.
constexpr double kDoubt = 1;

// The sampler of a run that may be cancelled, and what is known already.
struct LightAt {
  const IrradianceSampler& sampler;
  const ExecutionContext& context;
  SampleCache& samples;
  std::span<const KnownLight> known;
  const Enclosure& enclosure;
};

// True if the light at the vertices differs by more than the factor.
bool IsSteep(const QuadraticInterpolant& light, const Rgb& mean, double factor) {
  const Rgb floor = kErrorFloor * mean;
  const Rgb a = light.At(0, 0).max(floor), b = light.At(1, 0).max(floor), c = light.At(0, 1).max(floor);
  return (a.max(b).max(c) > factor * a.min(b).min(c)).any();
}

// Measures the errors of triangles for which the interpolants' gradients give reason. Returns the number of
// evaluations.
std::size_t MeasureSuspects(const Scene& scene, const MeshRefinementOptions& options, const LightAt& light,
                            RefinedMesh* refined) {
  const Rgb mean = MeanIrradiance(scene, refined->mesh).max(NoLight(scene) / kErrorFloor);
  const std::vector<double> guess = GuessTriangleErrors(scene, refined->mesh, mean);
  std::vector<std::uint32_t> suspects;
  for (std::uint32_t t = 0; t < guess.size(); ++t)
    if (guess[t] >= options.suspicion * options.error) suspects.push_back(t);
  MeasuredTriangles measured =
      MeasureTriangles(scene, refined->mesh, suspects, {options.samples, mean, &light.enclosure},
                       light.sampler, &light.samples);
  refined->errors = std::move(measured.errors);
  std::vector<std::uint32_t> doubtful;
  for (const std::uint32_t t : suspects)
    if (refined->errors[t].max <= options.error &&
        (guess[t] > kDoubt * options.error || IsSteep(refined->mesh.irradiance[t], mean, options.steep)))
      doubtful.push_back(t);
  const MeasuredTriangles finer =
      MeasureTriangles(scene, refined->mesh, doubtful, {options.samples + 1, mean, &light.enclosure},
                       light.sampler, &light.samples);
  for (const std::uint32_t t : doubtful)
    if (finer.errors[t].max > refined->errors[t].max) refined->errors[t] = finer.errors[t];
  RaiseErrors(scene, refined->mesh, light.known, {options.samples, mean, &light.enclosure}, refined->errors);
  return measured.point_evaluations + finer.point_evaluations;
}

// Makes the interpolants of refined->triangulations and measures them. Where predicted midpoints cause an
// error above the requested one, the midpoints are sampled: that costs less than smaller triangles. Returns
// the number of evaluations.
std::size_t Interpolate(const Scene& scene, const MeshOptions& mesh_options,
                        const MeshRefinementOptions& options, const LightAt& light, RefinedMesh* refined) {
  constexpr int kMostPasses = 2;
  std::size_t evaluations = 0;
  for (int pass = 1;; ++pass) {
    BuiltMesh built =
        BuildIrradianceMesh(scene, refined->triangulations, {mesh_options.order, mesh_options.smooth},
                            light.sampler, light.context, &light.samples);
    evaluations += built.point_evaluations;
    if (light.context.Cancelled()) return evaluations;
    refined->mesh = std::move(built.mesh);
    evaluations += MeasureSuspects(scene, options, light, refined);
    if (pass == kMostPasses) return evaluations;
    std::erase_if(built.predicted, [&](std::uint32_t t) { return refined->errors[t].max <= options.error; });
    if (built.predicted.empty() || light.context.Cancelled()) return evaluations;
    evaluations +=
        SampleMidpoints(scene, refined->mesh, built.predicted, light.sampler, light.context, light.samples);
  }
}

// Patches with a common error target: `error` must hold for all but `share` of their area.
struct Population {
  std::vector<PatchId> patches;
  double area = 0;  // [m^2]
  double error = 0;
  double share = 0;  // of the area, which may exceed the error
};

// The populations are the patches that are seen, those that are not (no picture shows the irradiance of a
// black wall, but a user may probe it), and each part of the former, so that a large part does not hide the
// errors of a small part.
std::vector<Population> FindPopulations(const Scene& scene, double error, double share) {
  const std::vector<double> seen = ReflectingAreas(scene);
  Population lit{{}, 0, error, share}, unseen = lit;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    Population& of = seen[p] > 0 ? lit : unseen;
    of.patches.push_back(static_cast<PatchId>(p));
    of.area += scene.patches[p].area;
  }
  std::vector<Population> populations = {std::move(lit), std::move(unseen)};
  const std::vector<ScenePart> parts = PartsOf(scene);
  if (parts.size() < 2) return populations;
  for (const ScenePart& part : parts) {
    // A part has few triangles, so that one of them is a large share of its area.
    Population own{part.patches, 0, kPartError * error, share / 2};
    for (const PatchId p : part.patches) own.area += seen[static_cast<std::size_t>(p)];
    if (own.area > 0) populations.push_back(std::move(own));
  }
  return populations;
}

// The area of the population with errors above its target [m^2], from the areas of patches.
double AreaOf(const Population& population, std::span<const double> areas) {
  double sum = 0;
  for (const PatchId p : population.patches) sum += areas[static_cast<std::size_t>(p)];
  return sum;
}

// The steps that reduce errors above `error`. `unmet` gets the leaves that are too small to be divided.
std::vector<RefinementStep> FindSteps(const Scene& scene, std::span<const OmittedOfPatch> omitted,
                                      const MeshRefinementOptions& options, double error,
                                      const RefinedMesh& refined, std::vector<ElementId>* unmet) {
  constexpr int kChildren = 4;
  const double floor = kErrorFloor * MeanIrradiance(scene, refined.mesh).maxCoeff();
  std::vector<RefinementStep> steps =
      FindRefinementSteps(refined.mesh, refined.triangulations, refined.errors, omitted, error, floor);
  unmet->clear();
  std::erase_if(steps, [&](const RefinementStep& step) {
    if (!step.Divides()) return false;
    const Element& element = refined.plan.forest[step.leaf];
    if (element.area >= kChildren * options.min_area && element.level < kMaxLevel) return false;
    unmet->push_back(step.leaf);
    return true;
  });
  std::sort(unmet->begin(), unmet->end());
  return steps;
}

// The steps that make all populations meet their targets, those with the largest benefit / cost first, each
// step once. REQUIRES: populations with equal targets are consecutive.
std::vector<RefinementStep> ChooseSteps(const Scene& scene, std::span<const Population> populations,
                                        std::span<const OmittedOfPatch> omitted,
                                        const MeshRefinementOptions& options, RefinedMesh* refined) {
  std::vector<RefinementStep> chosen;
  std::vector<std::vector<RefinementStep>> steps;  // by patch
  std::vector<double> above;
  std::set<std::tuple<PatchId, ElementId, std::size_t>> known;
  for (std::size_t k = 0; k < populations.size(); ++k) {
    const Population& population = populations[k];
    if (k == 0 || population.error != populations[k - 1].error) {
      std::vector<ElementId> unmet;
      steps.assign(scene.patches.size(), {});
      for (RefinementStep& step : FindSteps(scene, omitted, options, population.error, *refined, &unmet))
        steps[static_cast<std::size_t>(step.patch)].push_back(std::move(step));
      above = AreaAbove(scene, refined->mesh, refined->errors, population.error);
      if (k == 0) refined->unmet = std::move(unmet);
    }
    const double errs = AreaOf(population, above);
    if (k == 0) refined->share_above = population.area > 0 ? errs / population.area : 0;
    const double allowed = population.share * population.area;
    if (errs <= allowed) continue;
    std::vector<RefinementStep> own;
    for (const PatchId p : population.patches) {
      const std::vector<RefinementStep>& of = steps[static_cast<std::size_t>(p)];
      own.insert(own.end(), of.begin(), of.end());
    }
    for (const std::size_t i : ChooseRefinementSteps(own, errs - allowed))
      if (known.emplace(own[i].patch, own[i].leaf, own[i].discontinuity).second)
        chosen.push_back(std::move(own[i]));
  }
  return chosen;
}

// Applies the steps: divides leaves, and marks discontinuities as wanted.
void Take(std::span<const RefinementStep> chosen, std::span<const OmittedOfPatch> omitted, MeshPlan* plan) {
  plan->wanted.resize(omitted.size());
  std::vector<PatchId> divided;
  for (const RefinementStep& step : chosen) {
    if (step.Divides()) {
      divided.push_back(step.patch);
      plan->forest.Subdivide(step.leaf);
    } else {
      plan->wanted[step.patch].push_back(omitted[step.patch].found[step.discontinuity]);
    }
  }
  std::sort(divided.begin(), divided.end());
  divided.erase(std::unique(divided.begin(), divided.end()), divided.end());
  for (const PatchId patch : divided) plan->forest.Balance(patch);
}

// Moves the mesh of a complete round out of the refinement, which goes on from its plan.
RefinedMesh Keep(RefinedMesh& refined) {
  RefinedMesh kept;
  kept.plan = refined.plan;
  kept.triangulations = std::move(refined.triangulations);
  kept.mesh = std::move(refined.mesh);
  kept.errors = std::move(refined.errors);
  kept.report = refined.report;
  kept.share_above = refined.share_above;
  kept.unmet = refined.unmet;
  return kept;
}

}  // namespace

RefinedMesh RefineMesh(const LightToShow& light, const MeshOptions& mesh_options,
                       const MeshRefinementOptions& options, const ExecutionContext& context,
                       const RefinementMemory& memory) {
  PENUMBRA_CHECK(mesh_options.order != InterpolantOrder::kConstant);
  const Scene& scene = light.solution.forest.scene();
  const std::vector<Population> populations = FindPopulations(scene, options.error, options.share_above);
  SampleCache own_samples;
  SampleCache* const samples = memory.samples ? memory.samples : &own_samples;
  std::optional<LocalPassCache> own;  // from one round to the next
  LocalPassCache* const local_pass =
      memory.local_pass ? memory.local_pass : &own.emplace(scene, light.visibility);
  PatchTriangulator triangulator(light.visibility, light.solution, mesh_options.discontinuities, context,
                                 local_pass);
  triangulator.RankWith(light.sampler, samples);
  RefinedMesh refined, complete;  // of the present round, and of the round before
  refined.plan = memory.start ? *memory.start
                              : BeginPlan(light.visibility, light.solution, mesh_options.discontinuities);
  const Enclosure enclosure(scene);
  MeshReport::Seconds seconds;
  std::size_t evaluations = 0;
  for (int round = 0;; ++round) {
    refined.report = {};
    std::vector<OmittedOfPatch> omitted;
    refined.triangulations = triangulator.Triangulate(refined.plan, refined.report, &omitted);
    seconds.discontinuities += refined.report.seconds.discontinuities;
    seconds.triangulate += refined.report.seconds.triangulate;
    evaluations += refined.report.counts.point_evaluations;
    const Stopwatch interpolating;
    if (!context.Cancelled())
      evaluations += Interpolate(scene, mesh_options, options,
                                 {light.sampler, context, *samples, memory.known, enclosure}, &refined);
    seconds.interpolate += interpolating.Seconds();
    if (context.Cancelled()) {
      refined = std::move(complete);
      break;
    }
    if (memory.observer) memory.observer(refined.mesh);

    const std::vector<RefinementStep> chosen = ChooseSteps(scene, populations, omitted, options, &refined);
    const bool most = refined.mesh.triangles.size() > options.max_triangles;
    if (round == options.max_rounds || most || chosen.empty()) break;
    complete = Keep(refined);
    Take(chosen, omitted, &refined.plan);
  }
  refined.report.seconds = seconds;
  refined.report.counts.point_evaluations = evaluations;
  refined.report.counts.interpolants = refined.mesh.irradiance.size();
  return refined;
}

}  // namespace penumbra
