#include "solver/transport/solvers/sampled_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/base/parallel.h"
#include "solver/base/processes.h"
#include "solver/base/stopwatch.h"
#include "solver/geometry/vec_bytes.h"
#include "solver/scene/surface_points.h"
#include "solver/transport/links/element_locator.h"
#include "solver/transport/links/fragment_locator.h"
#include "solver/transport/points/diffuse_rays.h"
#include "solver/transport/points/ray_ends.h"
#include "solver/transport/solvers/anderson.h"
#include "solver/transport/sources/leaf_fragments.h"

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

// The luminaires of the scene. Points look for them together with their neighbours, in a cube of this times
// the side of one of the largest elements.
constexpr double kLookTogether = 8;
constexpr std::uint64_t kLookSeed = 3;

std::unique_ptr<const ShadowRays> LuminairesOf(const Scene& scene, const RayCaster& caster,
                                               const SampledOptions& options) {
  auto shadows = std::make_unique<ShadowRays>(scene, caster);
  if (scene.patches.empty()) return shadows;
  std::vector<ReceiverPoint> points;
  for (const SurfacePoint& at : SpreadPoints(scene, options.elements, kLookSeed)) {
    const Vec3& normal = scene.patches[static_cast<std::size_t>(at.patch)].normal;
    points.push_back({.position = at.position, .normal = normal, .approach = normal, .uncertainty = 0});
  }
  double area = 0;
  for (const Patch& patch : scene.patches) area += patch.area;
  shadows->Learn(points, kLookTogether * std::sqrt(area / static_cast<double>(options.elements)));
  return shadows;
}

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
      shadows_(LuminairesOf(scene, *caster_, options)),
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
      cells_(from.cells_),
      rows_(from.rows_),
      rays_(from.rays_),
      pass_(from.pass_),
      report_(from.report_),
      no_pairs_(PatchVisibility::WithoutPairs(other)),
      seen_from_leaves_(from.seen_from_leaves_) {
  solution_.forest = solution_.forest.Of(other);
  for (Fragment& fragment : solution_.fragments) fragment.irradiance = Rgb::Zero();
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

std::span<const Vec3> SampledSolver::PolygonOf(const Cell& cell) const {
  if (cell.fragment >= 0) return solution_.fragments[static_cast<std::size_t>(cell.fragment)].polygon;
  return solution_.forest[cell.leaf].Vertices();
}

double SampledSolver::AreaOf(const Cell& cell) const {
  return cell.fragment >= 0 ? solution_.fragments[static_cast<std::size_t>(cell.fragment)].area
                            : solution_.forest[cell.leaf].area;
}

const Rgb& SampledSolver::ReflectanceOf(const Cell& cell) const {
  return scene_.MaterialOf(solution_.forest[cell.leaf].patch).reflectance;
}

const SampledSolver::Direct& SampledSolver::DirectOf(const Cell& cell) const {
  return cell.fragment >= 0 ? direct_of_fragment_[static_cast<std::size_t>(cell.fragment)]
                            : direct_[static_cast<std::size_t>(cell.leaf)];
}

SampledSolver::Direct SampledSolver::DirectOn(PatchId patch, std::span<const Vec3> polygon,
                                              std::uint64_t seed) const {
  const Vec3& normal = scene_.patches[static_cast<std::size_t>(patch)].normal;
  std::array<ReceiverPoint, 4> at;
  for (std::size_t k = 0; k < at.size(); ++k)
    at[k] = {.position = PointOn(polygon, k % 2 == 0 ? 0.25 : 0.75, k < 2 ? 0.25 : 0.75),
             .normal = normal,
             .approach = normal,
             .uncertainty = 0};
  std::array<Rgb, 4> light;
  ShadowRayEffort effort = kRough;
  effort.seed = seed;
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

// Deals out the computation of direct light, of which compute(i) finds light[i].
void SampledSolver::DealDirect(std::span<Direct> light, const std::function<void(std::size_t i)>& compute) {
  const auto transfer = [&](std::size_t i, auto& archive) {
    Transfer(archive, light[i].mean);
    Transfer(archive, light[i].spread);
  };
  DealOut({light.size(), kGrain, compute, transfer, transfer});
}

void SampledSolver::LightNewElements(const ExecutionContext& context) {
  const std::size_t first = direct_.size();
  direct_.resize(solution_.forest.size());
  DealDirect(std::span(direct_).subspan(first), [&](std::size_t i) {
    if (context.Cancelled()) return;
    const Element& element = solution_.forest.elements()[first + i];
    direct_[first + i] = DirectOn(element.patch, element.Vertices(), first + i);
  });
}

void SampledSolver::LightFragments(const ExecutionContext& context) {
  direct_of_fragment_.resize(solution_.fragments.size());
  DealDirect(direct_of_fragment_, [&](std::size_t i) {
    if (context.Cancelled()) return;
    const Fragment& fragment = solution_.fragments[i];
    direct_of_fragment_[i] = DirectOn(solution_.forest[fragment.leaf].patch, fragment.polygon, i);
  });
}

// Cuts the leaves at contacts, and lists the cells.
void SampledSolver::FindCells(const ExecutionContext& context) {
  solution_.fragments = CutLeavesAtContacts(solution_.forest, context);
  cells_.clear();
  if (context.Cancelled()) return;
  const FragmentLocator fragments(solution_);
  for (const ElementId leaf : push_pull_.leaves()) {
    if (fragments.IsWhole(leaf)) cells_.push_back({leaf, -1});
    for (std::int32_t f = fragments.FirstOf(leaf); f < fragments.FirstOf(leaf + 1); ++f)
      cells_.push_back({leaf, f});
  }
  LightFragments(context);
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
  std::vector<std::int32_t> place(solution_.forest.size(), -1);  // of the first cell of a leaf
  for (std::size_t i = cells_.size(); i-- > 0;)
    place[static_cast<std::size_t>(cells_[i].leaf)] = static_cast<std::int32_t>(i);
  std::vector<std::int32_t> rows(cells_.size() * rays, -1);
  rays_ = rays;
  const double lift = RayLift(scene_);
  const ElementLocator elements(solution_.forest);
  const FragmentLocator fragments(solution_);
  const auto compute = [&](std::size_t i) {
    if (context.Cancelled()) return;
    const std::span<const Vec3> polygon = PolygonOf(cells_[i]);
    const PatchId patch = solution_.forest[cells_[i].leaf].patch;
    const Vec3& normal = scene_.patches[static_cast<std::size_t>(patch)].normal;
    for (std::size_t k = 0; k < rays; ++k) {
      const DiffuseRay ray = MakeDiffuseRay(polygon, normal, lift, k, i);
      const RayCaster::Hit hit = caster_->Cast(ray.origin, ray.direction);
      if (hit.patch == kNoPatch || !hit.front) continue;
      const Vec3 end = ray.origin + hit.distance * ray.direction;
      const ElementId leaf = elements.LeafAt(hit.patch, end);
      const std::int32_t fragment = fragments.At(leaf, end);
      rows[i * rays + k] =
          place[static_cast<std::size_t>(leaf)] + (fragment >= 0 ? fragment - fragments.FirstOf(leaf) : 0);
    }
  };
  const auto transfer = [&](std::size_t i, auto& archive) {
    archive.Raw(rows.data() + i * rays, rays * sizeof(std::int32_t));
  };
  DealOut({cells_.size(), kGrain, compute, transfer, transfer});
  report_.interactions.sampled = rows.size();
  rows_ = std::make_shared<const std::vector<std::int32_t>>(std::move(rows));
}

// The irradiance by the reflected part of the given irradiance; both are in the order of the cells.
std::vector<Rgb> SampledSolver::Gather(std::span<const Rgb> irradiance) const {
  std::vector<Rgb> reflected(cells_.size());
  for (std::size_t i = 0; i < cells_.size(); ++i) reflected[i] = ReflectanceOf(cells_[i]) * irradiance[i];
  std::vector<Rgb> gathered(cells_.size());
  ParallelFor(cells_.size(), kGrain, [&](std::size_t i) {
    Rgb sum = Rgb::Zero();
    for (std::size_t k = i * rays_; k < (i + 1) * rays_; ++k)
      if ((*rows_)[k] >= 0) sum += reflected[static_cast<std::size_t>((*rows_)[k])];
    gathered[i] = sum / static_cast<double>(rays_);
  });
  return gathered;
}

// Sets the light of all cells [W/m^2], given in their order, and of the elements above them.
void SampledSolver::SetLightOf(std::span<const Rgb> irradiance) {
  for (std::size_t i = 0; i < cells_.size();) {
    const ElementId leaf = cells_[i].leaf;
    const Rgb emittance = scene_.MaterialOf(solution_.forest[leaf].patch).emittance;
    Rgb flux = Rgb::Zero();
    double area = 0;
    for (; i < cells_.size() && cells_[i].leaf == leaf; ++i) {
      const Rgb light = irradiance[i].max(0.0);
      flux += AreaOf(cells_[i]) * light;
      area += AreaOf(cells_[i]);
      if (cells_[i].fragment < 0) continue;
      Fragment& fragment = solution_.fragments[static_cast<std::size_t>(cells_[i].fragment)];
      fragment.irradiance = light;
      fragment.radiosity = emittance + ReflectanceOf(cells_[i]) * light;
    }
    const bool is_whole = cells_[i - 1].fragment < 0;
    push_pull_.Light(leaf, is_whole ? irradiance[i - 1] : Rgb(flux / area));
  }
  push_pull_.Pull();
  push_pull_.UpdateSpreads();
}

// Sweeps from direct light until the light changes by no more than the cut-off: what no light reaches stays
// dark. Returns the number of sweeps.
std::size_t SampledSolver::Settle(const ExecutionContext& context) {
  std::vector<double> weight;
  std::vector<Rgb> direct;
  for (const Cell& cell : cells_) {
    weight.push_back(AreaOf(cell));
    direct.push_back(DirectOf(cell).mean);
  }
  std::vector<Rgb> light = direct;
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
  if (!context.Cancelled()) SetLightOf(light);
  return sweeps;
}

// Undoes a pass: `elements` is the number of elements before it.
void SampledSolver::GoBackTo(std::size_t elements, Transport before) {
  solution_.forest.Truncate(elements);
  for (auto* values : {&solution_.irradiance, &solution_.radiosity}) values->resize(elements);
  solution_.fragments = std::move(before.fragments);
  cells_ = std::move(before.cells);
  rows_ = std::move(before.rows);
  rays_ = before.rays;
  direct_.clear();
  push_pull_.Update();
}

bool SampledSolver::Step(SolverStep step, const ExecutionContext& context) {
  if (step != SolverStep::kIterate) return false;
  const Stopwatch stopwatch;
  const Limits limits = LimitsOf(pass_);
  const std::size_t elements = solution_.forest.size();
  Transport before = {std::exchange(solution_.fragments, {}), std::exchange(cells_, {}), rows_, rays_};
  Divide(limits, context);
  FindCells(context);
  SampleMatrix(limits.rays, context);
  const std::size_t sweeps = Settle(context);
  seen_from_leaves_.Reset();
  if (context.Cancelled()) {
    GoBackTo(elements, std::move(before));
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
  shadows_ = LuminairesOf(scene_, *caster_, options_);
  direct_.clear();
  LightNewElements(context);
  LightFragments(context);
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
  std::vector<Rgb> light;
  for (const Cell& cell : cells_) light.push_back(DirectOf(cell).mean);
  for (int bounce = 0; bounce < bounces; ++bounce) {
    Rgb flux = Rgb::Zero();
    double area = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      flux += AreaOf(cells_[i]) * light[i];
      area += AreaOf(cells_[i]);
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
