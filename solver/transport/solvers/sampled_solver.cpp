#include "solver/transport/solvers/sampled_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/base/parallel.h"
#include "solver/base/stopwatch.h"
#include "solver/scene/surface_points.h"
#include "solver/transport/links/element_locator.h"
#include "solver/transport/points/ray_ends.h"
#include "solver/transport/solvers/anderson.h"
#include "solver/transport/solvers/diffuse_rays.h"

namespace penumbra {
namespace {

constexpr std::size_t kGrain = 16;
// Elements are divided while their direct light varies, unless the variation of the flux that they reflect is
// below kLeastFlux times all reflected flux.
constexpr double kLeastFlux = 0.015;
// Light below this times the mean counts as dark: its variation is measured against the mean.
constexpr double kDark = 0.05;
// A pass before the last one allows areas and spreads that are larger by these factors for each pass to come.
constexpr double kCoarserArea = 8, kCoarserSpread = 3;
constexpr int kMostLevels = 10;
constexpr std::size_t kMostSweeps = 100'000;
// Direct light on elements: its errors average out over the elements that a point sees.
constexpr ShadowRayEffort kRough = {
    .divisions = 2, .closer_above = std::numeric_limits<double>::infinity(), .seed = 0};

RadiositySolution Unlit(const Scene& scene, const SampledOptions& options) {
  RadiositySolution solution;
  solution.forest = ElementForest(scene);
  solution.rays_per_point = options.point_rays;
  return solution;
}

}  // namespace

SampledSolver::SampledSolver(const Scene& scene, const SampledOptions& options)
    : scene_(scene),
      options_(options),
      caster_(std::make_shared<const RayCaster>(scene)),
      shadows_(std::make_unique<const ShadowRays>(scene, *caster_)),
      solution_(Unlit(scene, options)),
      push_pull_(solution_),
      no_pairs_(PatchVisibility::WithoutPairs(scene)) {
  report_.most_iterations = options.passes;
}

SampledSolver::SampledSolver(const SampledSolver& from, const Scene& other)
    : scene_(other),
      options_(from.options_),
      caster_(from.caster_),
      solution_(from.solution_),
      push_pull_(solution_),
      rows_(from.rows_),
      rays_(from.rays_),
      pass_(from.pass_),
      report_(from.report_),
      no_pairs_(PatchVisibility::WithoutPairs(other)),
      seen_from_leaves_(from.seen_from_leaves_) {
  solution_.forest = solution_.forest.Of(other);
  std::fill(solution_.irradiance.begin(), solution_.irradiance.end(), Rgb::Zero());
}

std::optional<SolverStep> SampledSolver::Next() const {
  return pass_ < options_.passes ? std::optional(SolverStep::kIterate) : std::nullopt;
}

SampledSolver::Limits SampledSolver::LimitsOf(int pass) const {
  const int to_come = std::max(0, options_.passes - 1 - pass);
  double area = 0;
  for (const Patch& patch : scene_.patches) area += patch.area;
  return {area / static_cast<double>(options_.elements) * std::pow(kCoarserArea, to_come),
          options_.relative_spread * std::pow(kCoarserSpread, to_come),
          std::max<std::size_t>(8, options_.element_rays >> static_cast<unsigned>(2 * to_come))};
}

SampledSolver::Direct SampledSolver::DirectOn(ElementId id) const {
  const Element& element = solution_.forest[id];
  const Vec3& normal = scene_.patches[static_cast<std::size_t>(element.patch)].normal;
  std::array<ReceiverPoint, 4> at;
  for (std::size_t k = 0; k < at.size(); ++k)
    at[k] = {.position = PointOn(element.Vertices(), k % 2 == 0 ? 0.25 : 0.75, k < 2 ? 0.25 : 0.75),
             .normal = normal,
             .approach = normal,
             .uncertainty = 0};
  std::array<Rgb, 4> light;
  ShadowRayEffort effort = kRough;
  effort.seed = static_cast<std::uint64_t>(id);
  shadows_->AtAll(at, effort, light);
  Direct direct;
  for (const Rgb& l : light) direct.mean += l / 4;
  for (const Rgb& l : light) direct.spread += (l - direct.mean).square() / 4;
  direct.spread = direct.spread.sqrt();
  return direct;
}

bool SampledSolver::MustDivide(ElementId id, const Limits& limits, double least_flux) const {
  const Element& element = solution_.forest[id];
  if (!element.IsLeaf() || element.level >= kMostLevels) return false;
  if (element.area > limits.largest_area) return true;
  const Rgb& reflectance = scene_.MaterialOf(element.patch).reflectance;
  const Direct& direct = direct_[static_cast<std::size_t>(id)];
  const Rgb reflected = solution_.irradiance[static_cast<std::size_t>(id)].max(direct.mean);
  const Rgb varies = direct.spread - limits.relative_spread * reflected;
  return (varies > 0 && reflectance * direct.spread * element.area > least_flux).any();
}

void SampledSolver::LightNewElements(const ExecutionContext& context) {
  const std::size_t first = direct_.size();
  direct_.resize(solution_.forest.size());
  ParallelFor(direct_.size() - first, kGrain, [&](std::size_t i) {
    if (!context.Cancelled()) direct_[first + i] = DirectOn(static_cast<ElementId>(first + i));
  });
}

void SampledSolver::Divide(const Limits& limits, const ExecutionContext& context) {
  LightNewElements(context);
  std::size_t first = 0;  // elements before this one stay as they are
  while (!context.Cancelled()) {
    double flux = 0;
    for (const ElementId leaf : solution_.forest.AllLeaves()) {
      const Element& element = solution_.forest[leaf];
      flux += element.area *
              (scene_.MaterialOf(element.patch).reflectance * direct_[static_cast<std::size_t>(leaf)].mean)
                  .maxCoeff();
    }
    const std::size_t count = solution_.forest.size();
    for (std::size_t e = first; e < count && solution_.forest.size() < options_.max_elements; ++e)
      if (MustDivide(static_cast<ElementId>(e), limits,
                     kLeastFlux * flux / static_cast<double>(options_.elements)))
        solution_.forest.Subdivide(static_cast<ElementId>(e));
    if (solution_.forest.size() == count) break;
    push_pull_.Update();
    LightNewElements(context);
    first = count;
  }
  for (PatchId p = 0; p < static_cast<PatchId>(scene_.patches.size()); ++p) solution_.forest.Balance(p);
  push_pull_.Update();
  LightNewElements(context);
}

void SampledSolver::SampleMatrix(std::size_t rays, const ExecutionContext& context) {
  const std::span<const ElementId> leaves = push_pull_.leaves();
  std::vector<std::int32_t> place(solution_.forest.size(), -1);
  for (std::size_t i = 0; i < leaves.size(); ++i)
    place[static_cast<std::size_t>(leaves[i])] = static_cast<std::int32_t>(i);
  std::vector<std::int32_t> rows(leaves.size() * rays, -1);
  rays_ = rays;
  const double lift = RayLift(scene_);
  const ElementLocator elements(solution_.forest);
  ParallelFor(leaves.size(), kGrain, [&](std::size_t i) {
    if (context.Cancelled()) return;
    const Element& element = solution_.forest[leaves[i]];
    const Vec3& normal = scene_.patches[static_cast<std::size_t>(element.patch)].normal;
    for (std::size_t k = 0; k < rays; ++k) {
      const DiffuseRay ray = MakeDiffuseRay(element.Vertices(), normal, lift, k, i);
      const RayCaster::Hit hit = caster_->Cast(ray.origin, ray.direction);
      if (hit.patch == kNoPatch || !hit.front) continue;
      const ElementId leaf = elements.LeafAt(hit.patch, ray.origin + hit.distance * ray.direction);
      rows[i * rays + k] = place[static_cast<std::size_t>(leaf)];
    }
  });
  report_.interactions.sampled = rows.size();
  rows_ = std::make_shared<const std::vector<std::int32_t>>(std::move(rows));
}

// The irradiance by the reflected part of the given irradiance; both are in the order of the leaves.
std::vector<Rgb> SampledSolver::Gather(std::span<const Rgb> irradiance) const {
  const std::span<const ElementId> leaves = push_pull_.leaves();
  std::vector<Rgb> reflected(leaves.size());
  for (std::size_t i = 0; i < leaves.size(); ++i)
    reflected[i] = scene_.MaterialOf(solution_.forest[leaves[i]].patch).reflectance * irradiance[i];
  std::vector<Rgb> gathered(leaves.size());
  ParallelFor(leaves.size(), kGrain, [&](std::size_t i) {
    Rgb sum = Rgb::Zero();
    for (std::size_t k = i * rays_; k < (i + 1) * rays_; ++k)
      if ((*rows_)[k] >= 0) sum += reflected[static_cast<std::size_t>((*rows_)[k])];
    gathered[i] = sum / static_cast<double>(rays_);
  });
  return gathered;
}

// Sweeps from the present light until it changes by no more than the cut-off. Returns the number of sweeps.
std::size_t SampledSolver::Settle(const ExecutionContext& context) {
  const std::span<const ElementId> leaves = push_pull_.leaves();
  std::vector<double> weight;
  std::vector<Rgb> light, direct;
  for (const ElementId leaf : leaves) {
    weight.push_back(solution_.forest[leaf].area);
    direct.push_back(direct_[static_cast<std::size_t>(leaf)].mean);
    light.push_back(solution_.irradiance[static_cast<std::size_t>(leaf)].max(direct.back()));
  }
  AndersonAcceleration faster(std::move(weight));
  std::size_t sweeps = 0;
  residual_ = 1;
  while (residual_ > options_.relative_cutoff && sweeps < kMostSweeps && !context.Cancelled()) {
    std::vector<Rgb> next = Gather(light);
    double change = 0, largest = 0;
    for (std::size_t i = 0; i < next.size(); ++i) {
      next[i] += direct[i];
      change = std::max(change, (next[i] - light[i]).abs().maxCoeff());
      largest = std::max(largest, next[i].maxCoeff());
    }
    residual_ = largest > 0 ? change / largest : 0;
    ++sweeps;
    if (residual_ > options_.relative_cutoff) faster.Improve(light, next);
    light.swap(next);
  }
  if (context.Cancelled()) return sweeps;
  for (std::size_t i = 0; i < leaves.size(); ++i) push_pull_.Light(leaves[i], light[i].max(0.0));
  push_pull_.Pull();
  push_pull_.UpdateSpreads();
  return sweeps;
}

bool SampledSolver::Step(SolverStep step, const ExecutionContext& context) {
  if (step != SolverStep::kIterate) return false;
  const Stopwatch stopwatch;
  const Limits limits = LimitsOf(pass_);
  const std::size_t before = solution_.forest.size();
  Divide(limits, context);
  SampleMatrix(limits.rays, context);
  const std::size_t sweeps = Settle(context);
  seen_from_leaves_.Reset();
  if (context.Cancelled()) {
    solution_.forest.Truncate(before);
    for (auto* values : {&solution_.irradiance, &solution_.radiosity}) values->resize(before);
    direct_.clear();
    push_pull_.Update();
    return false;
  }
  ++pass_;
  Report(sweeps, stopwatch.Seconds());
  return true;
}

void SampledSolver::Report(std::size_t sweeps, double seconds) {
  IterationReport iteration;
  iteration.residual = residual_;
  iteration.elements = solution_.forest.size();
  iteration.sweeps = sweeps;
  iteration.seconds = seconds;
  report_.iterations.push_back(iteration);
}

bool SampledSolver::Relight(const ExecutionContext& context) {
  if (rays_ == 0) return Step(SolverStep::kIterate, context);
  const Stopwatch stopwatch;
  shadows_ = std::make_unique<const ShadowRays>(scene_, *caster_);
  direct_.clear();
  LightNewElements(context);
  const std::size_t sweeps = context.Cancelled() ? 0 : Settle(context);
  if (context.Cancelled()) return false;
  Report(sweeps, stopwatch.Seconds());
  return true;
}

std::unique_ptr<LightSolver> SampledSolver::LitAs(const Scene& other, const ExecutionContext& context) const {
  if (rays_ == 0) return nullptr;
  std::unique_ptr<SampledSolver> lit(new SampledSolver(*this, other));
  if (!lit->Relight(context)) return nullptr;
  return lit;
}

void SampledSolver::ReplaceLight(std::span<const Rgb> element, std::span<const Rgb> fragment) {
  ReplaceIrradiance(element, fragment, solution_);
}

bool SampledSolver::SetLight(std::span<const Rgb>, std::vector<Fragment>, const ExecutionContext&) {
  PENUMBRA_CHECK(TakesLight());
  return false;
}

std::shared_ptr<const LeafVisibility> SampledSolver::SeenFromLeaves(const ExecutionContext& context) {
  return seen_from_leaves_.Get(solution_.forest, no_pairs_, context);
}

std::vector<Rgb> SampledSolver::MeanIrradianceByBounce(int bounces) const {
  std::vector<Rgb> means;
  if (rays_ == 0) return means;
  const std::span<const ElementId> leaves = push_pull_.leaves();
  std::vector<Rgb> light;
  for (const ElementId leaf : leaves) light.push_back(direct_[static_cast<std::size_t>(leaf)].mean);
  for (int bounce = 0; bounce < bounces; ++bounce) {
    Rgb flux = Rgb::Zero();
    double area = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      flux += solution_.forest[leaves[i]].area * light[i];
      area += solution_.forest[leaves[i]].area;
    }
    means.push_back(flux / area);
    light = Gather(light);
  }
  return means;
}

LightSolverRegistry::Method SampledSolverMethod() {
  return {"sampled",
          "form factors by rays from elements, and final gathering at points: for scenes of many polygons",
          {"rays"},
          [](const SolverScene& in, const LightSolverOptions& options, const ExecutionContext&) {
            if (in.goes_on_from) return std::unique_ptr<SampledSolver>();
            return std::make_unique<SampledSolver>(in.scene, options.sampled);
          }};
}

}  // namespace penumbra
