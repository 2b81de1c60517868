#include "mesh/mesh_refinement.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "mesh/refinement_step.h"
#include "solver/base/check.h"
#include "solver/base/stopwatch.h"

namespace penumbra {
namespace {

// Triangles whose gradients jump by less than what leads to this share of the error asked for are not
// measured.
constexpr double kSuspicion = 0.3;
// Beyond this, a triangle that was found good is looked at once more, at finer points.
constexpr double kDoubt = 1;

// Measures the triangles' errors where the interpolants' gradients give reason to. Returns how many points
// were evaluated.
std::size_t MeasureSuspects(const Scene& scene, const MeshRefinementOptions& options,
                            const IrradianceSampler& sampler, SampleCache* samples, RefinedMesh* refined) {
  const Rgb mean = MeanIrradiance(refined->mesh);
  const std::vector<double> guess = GuessTriangleErrors(scene, refined->mesh, mean);
  std::vector<std::uint32_t> suspects;
  for (std::uint32_t t = 0; t < guess.size(); ++t)
    if (guess[t] > kSuspicion * options.error) suspects.push_back(t);
  MeasuredTriangles measured =
      MeasureTriangles(scene, refined->mesh, suspects, options.samples, mean, sampler, samples);
  refined->errors = std::move(measured.errors);
  std::vector<std::uint32_t> doubtful;
  for (const std::uint32_t t : suspects)
    if (refined->errors[t].max <= options.error && guess[t] > kDoubt * options.error) doubtful.push_back(t);
  const MeasuredTriangles finer =
      MeasureTriangles(scene, refined->mesh, doubtful, options.samples + 1, mean, sampler, samples);
  for (const std::uint32_t t : doubtful)
    if (finer.errors[t].max > refined->errors[t].max) refined->errors[t] = finer.errors[t];
  return measured.point_evaluations + finer.point_evaluations;
}

// What can be done about the errors. Leaves that are too small to be divided are unmet.
std::vector<RefinementStep> FindSteps(std::span<const OmittedOfPatch> omitted,
                                      const MeshRefinementOptions& options, RefinedMesh* refined) {
  constexpr int kChildren = 4;
  std::vector<RefinementStep> steps =
      FindRefinementSteps(refined->mesh, refined->triangulations, refined->errors, omitted, options.error);
  refined->unmet.clear();
  std::erase_if(steps, [&](const RefinementStep& step) {
    if (!step.Divides()) return false;
    const Element& element = refined->plan.forest[step.leaf];
    if (element.area >= kChildren * options.min_area && element.level < kMaxLevel) return false;
    refined->unmet.push_back(step.leaf);
    return true;
  });
  std::sort(refined->unmet.begin(), refined->unmet.end());
  return steps;
}

// Does it: leaves are divided, discontinuities wanted from now on.
void Take(std::span<const RefinementStep> steps, std::span<const std::size_t> chosen,
          std::span<const OmittedOfPatch> omitted, MeshPlan* plan) {
  plan->wanted.resize(omitted.size());
  std::vector<PatchId> divided;
  for (const std::size_t i : chosen) {
    const RefinementStep& step = steps[i];
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

}  // namespace

RefinedMesh RefineMesh(const PatchVisibility& visibility, const RadiositySolution& solution,
                       const IrradianceSampler& sampler, const MeshOptions& mesh_options,
                       const MeshRefinementOptions& options, const ExecutionContext& context,
                       LocalPassCache* local_pass, const MeshPlan* start, SampleCache* samples) {
  PENUMBRA_CHECK(mesh_options.order != InterpolantOrder::kConstant);
  const Scene& scene = solution.forest.scene();
  double area = 0;
  for (const Patch& patch : scene.patches) area += patch.area;
  SampleCache own_samples;
  if (!samples) samples = &own_samples;
  std::optional<LocalPassCache> own;
  if (!local_pass) local_pass = &own.emplace(scene, visibility);
  RefinedMesh refined;
  refined.plan = start ? *start : BeginPlan(visibility, solution, mesh_options.discontinuities);
  MeshReport::Seconds seconds;
  std::size_t evaluations = 0;
  for (int round = 0;; ++round) {
    refined.report = {};
    std::vector<OmittedOfPatch> omitted;
    refined.triangulations =
        TriangulatePatches(visibility, solution, refined.plan, mesh_options.discontinuities, context,
                           refined.report, local_pass, &omitted);
    seconds.discontinuities += refined.report.seconds.discontinuities;
    seconds.triangulate += refined.report.seconds.triangulate;
    const Stopwatch interpolating;
    if (context.Cancelled()) return {};
    BuiltMesh built =
        BuildIrradianceMesh(scene, refined.triangulations, mesh_options.order, sampler, context, samples);
    if (context.Cancelled()) return {};
    refined.mesh = std::move(built.mesh);
    evaluations += built.point_evaluations;
    evaluations += MeasureSuspects(scene, options, sampler, samples, &refined);
    seconds.interpolate += interpolating.Seconds();

    const double above = AreaAbove(refined.mesh, refined.errors, options.error);
    refined.share_above = area > 0 ? above / area : 0;
    const std::vector<RefinementStep> steps = FindSteps(omitted, options, &refined);
    if (round == options.max_rounds) break;
    const std::vector<std::size_t> chosen = ChooseRefinementSteps(steps, above - kShareAbove * area);
    if (chosen.empty()) break;
    Take(steps, chosen, omitted, &refined.plan);
  }
  refined.report.seconds = seconds;
  refined.report.counts.point_evaluations = evaluations;
  refined.report.counts.interpolants = refined.mesh.irradiance.size();
  return refined;
}

}  // namespace penumbra
