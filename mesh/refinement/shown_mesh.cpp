#include "mesh/refinement/shown_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "mesh/interpolants/known_light.h"
#include "mesh/interpolants/representation_error.h"
#include "mesh/refinement/emitter_sources.h"
#include "solver/base/check.h"
#include "solver/base/stopwatch.h"
#include "solver/transport/solvers/hierarchical_solver.h"

namespace penumbra {
namespace {

// The tolerance of the interpolants' samples for details of their sources, as a fraction of the error. The
// means of the samples correct the light of the sources, so that a common error grows from bounce to bounce.
constexpr double kSampleShare = 0.2;
// Refinement that may request edges starts with edges of kWeightToBegin times the minimum weight.
constexpr double kWeightToBegin = 2;
// The light of single emitters: the tolerance of rows, as a fraction of that of other samples, since a source
// that is dim in the whole light may be the brightest of one emitter; and the change, as a fraction of the
// error, at which its sources have settled: turns take products only, and may be many.
constexpr double kEmitterShare = 0.5, kEmitterSettledShare = 0.05;
// Interpolation::smooth, as a fraction of the error, and at most: gradients over triangles say little where
// light bends by more.
constexpr double kSmoothShare = 0.5, kMostSmooth = 0.02;
// Sources are refined again while the means would still change by more than kSettledShare of the error, at
// most kMostSourcePasses times. Most rooms need two to four passes; a narrow slot between white walls, where
// light bounces many times, needs twenty. The passes end earlier if two passes leave more than kStill of a
// change.
constexpr double kSettledShare = 0.6, kStill = 0.95;
constexpr int kMostSourcePasses = 40, kFewestSourcePasses = 3;
// The rounds of refinement of the mesh that determines the sources: means need fewer than what is shown.
constexpr int kRoundsForSources = 2;
// Measurements at centroids can overlook errors that random points show. Random points therefore test the
// refined mesh, one per kEvaluationsALook evaluations of the refinement. While the 99th percentile may be
// above kOverlooked times the error, the mesh is refined further; the new target is smaller by the ratio of
// the two, within limits.
constexpr std::size_t kEvaluationsALook = 20, kFewestLooks = 1000, kMostLooks = 3000;
constexpr double kOverlooked = 0.9, kLeastOnward = 0.5, kMostOnward = 0.9;
// The factor by which each further turn reduces MeshOptions::smooth.
constexpr double kOnwardSmooth = 0.25;
// Sources are divided while their score is above kFinestScore times the error; for measurements of the error,
// while it is above kMeasuredScore times the error.
constexpr double kFinestScore = 2, kMeasuredScore = 1;

}  // namespace

ShownMesh::ShownMesh(const Scene& scene, const PatchVisibility& visibility, CurrentIrradiance& irradiance,
                     const ShownMeshOptions& options)
    : scene_(scene), visibility_(visibility), irradiance_(irradiance), options_(options) {}

void ShownMesh::Begin() {
  report_ = {};
  seconds_of_sources_ = 0;
  has_looked_ = false;
  unmet_.reset();
}

bool ShownMesh::Make(const RadiositySolution& solution, const MeshOptions& options,
                     const ExecutionContext& context) {
  Begin();
  // The result depends on the solution alone, not on samples for earlier lights.
  return FirstLook(solution, options, nullptr, context);
}

namespace {

// The options of the first mesh of the leaves, before refinement requests lighter edges and more samples.
MeshOptions ToBeginWith(const MeshOptions& options, double error) {
  MeshOptions first = options;
  first.smooth = std::min(kSmoothShare * error, kMostSmooth);
  if (options.discontinuities.can_want()) first.discontinuities.min_weight *= kWeightToBegin;
  return first;
}

}  // namespace

bool ShownMesh::RefineLight(LightSolver& solver, const MeshOptions& options,
                            const ExecutionContext& context) {
  Begin();
  cells_.clear();
  const MeshOptions first = ToBeginWith(options, options_.error);
  if (!FirstLook(solver.solution(), first, &samples_, context)) return false;
  has_looked_ = true;
  if (mesh_.triangles.empty()) return true;
  if (!SettleSources(solver, first, context)) return false;
  light_plan_ = plan_;
  return true;
}

bool ShownMesh::MakeRefined(const RadiositySolution& solution, const MeshOptions& options,
                            const ExecutionContext& context) {
  const bool shows_first_look = std::exchange(has_looked_, false);
  if (!shows_first_look) Begin();
  if (!shows_first_look && light_plan_) {
    plan_ = *light_plan_;
    return RefineLeaves(solution, ToBeginWith(options, options_.error), context);
  }
  if (!shows_first_look && !FirstLook(solution, ToBeginWith(options, options_.error), &samples_, context))
    return false;
  if (!mesh_.triangles.empty()) RefineLeaves(solution, ToBeginWith(options, options_.error), context);
  return true;
}

std::optional<std::vector<EmitterLight>> ShownMesh::SplitLight(const LightSolver& solver,
                                                               std::span<const std::vector<PatchId>> emitters,
                                                               const MeshOptions& options,
                                                               const ExecutionContext& context) {
  const PointIrradiance* const exact = irradiance_.Get(context);
  if (!exact) return std::nullopt;
  const MeshOptions first = ToBeginWith(options, options_.error);
  const SourceMesh mesh = {
      plan_.forest,  triangulations_,    {first.order, first.smooth},          cells_, *exact, samples_,
      samples_from_, EmitterTolerance(), kEmitterSettledShare * options_.error};
  return SolveByEmitter(solver, emitters, &mesh, context);
}

double ShownMesh::EmitterTolerance() const { return kEmitterShare * Tolerance(); }

void ShownMesh::SetInterpolants(std::vector<QuadraticInterpolant> irradiance) {
  PENUMBRA_CHECK(irradiance.size() == mesh_.triangles.size());
  mesh_.irradiance = std::move(irradiance);
}

MeshSeconds ShownMesh::TakeSeconds() {
  return {std::exchange(seconds_of_sources_, 0), std::exchange(report_.seconds, {})};
}

void ShownMesh::Take(IrradianceMesh mesh) {
  Begin();
  mesh_ = std::move(mesh);
  triangulations_.clear();
  triangle_errors_.clear();
}

std::unique_ptr<const PointIrradiance> ShownMesh::BetterIrradiance(const RadiositySolution& solution,
                                                                   const SourceCells& finest,
                                                                   const ExecutionContext& context) {
  if (context.Cancelled()) return nullptr;
  HierarchicalSolver better(scene_, visibility_, options_.solver, solution, context);
  if (!better.SetLight(finest.LeafIrradiance(), finest.Fragments(/*whole_leaves=*/true), context))
    return nullptr;
  return std::make_unique<const PointIrradiance>(
      irradiance_.Get()->WithSources(SourceSet::FromSolution(better.solution())));
}

std::unique_ptr<const PointIrradiance> ShownMesh::ShownIrradiance(const RadiositySolution& solution,
                                                                  const SourceCells& finest) {
  return std::make_unique<const PointIrradiance>(irradiance_.Get()->WithSources(
      SourceSet::FromSolution(solution, finest.Fragments(/*whole_leaves=*/true))));
}

SourceCells ShownMesh::CellsOf(const RadiositySolution& solution, double finest,
                               const ExecutionContext& context) {
  return SourceCells(solution, {plan_.forest, triangulations_, mesh_}, *irradiance_.Get(), {finest, cells_},
                     context);
}

SourceCells ShownMesh::FinestCells(const RadiositySolution& solution, const ExecutionContext& context) {
  return CellsOf(solution, kMeasuredScore * options_.error, context);
}

double ShownMesh::Tolerance() const { return kSampleShare * options_.error; }

IrradianceSampler ShownMesh::Sampler(Rows rows, const ExecutionContext& context) {
  const PointIrradiance& exact = *irradiance_.Get();
  return WhileGoing(
      rows == Rows::kRecord ? RecordingSampler(exact, Tolerance()) : NearSampler(exact, Tolerance()),
      context);
}

LocalPassCache& ShownMesh::LocalPass() {
  if (!local_pass_) local_pass_ = std::make_unique<LocalPassCache>(scene_, visibility_);
  return *local_pass_;
}

// Replaces the counts by those of the latest mesh, and adds up the work.
void ShownMesh::Add(MeshReport latest) {
  latest.counts.point_evaluations += report_.counts.point_evaluations;
  latest.counts.sources_renewed += report_.counts.sources_renewed;
  latest.seconds.discontinuities += report_.seconds.discontinuities;
  latest.seconds.triangulate += report_.seconds.triangulate;
  latest.seconds.interpolate += report_.seconds.interpolate;
  report_ = latest;
}

// Makes a mesh of the solution's leaves. False if cancelled.
bool ShownMesh::FirstLook(const RadiositySolution& solution, const MeshOptions& options, SampleCache* samples,
                          const ExecutionContext& context) {
  IrradianceSampler sampler;
  if (options.order != InterpolantOrder::kConstant) {
    const Stopwatch stopwatch;
    const bool ready = samples ? RelightSamples(context) : irradiance_.Get(context) != nullptr;
    if (!ready) return false;
    report_.seconds.interpolate += stopwatch.Seconds();
    sampler = Sampler(samples ? Rows::kRecord : Rows::kNone, context);
  }
  MeshResult result = RunLocalPass(visibility_, solution, sampler, options, context, {&LocalPass(), samples});
  if (context.Cancelled()) {
    samples_.Clear();
    return false;
  }
  Add(result.report);
  mesh_ = std::move(result.mesh);
  triangulations_ = std::move(result.triangulations);
  plan_ = std::move(result.plan);
  triangle_errors_.clear();
  if (observer_) observer_(mesh_);
  return true;
}

// Alternately refines the sources by what they show, and shows them again, until the light settles: remaining
// changes return by the bounces between walls that face each other. False if cancelled.
bool ShownMesh::SettleSources(LightSolver& solver, const MeshOptions& options,
                              const ExecutionContext& context) {
  MeshRefinementOptions rough = RefinementTo(options_.interpolant_share * options_.error);
  rough.max_rounds = kRoundsForSources;
  double before = 0, ratio_before = 0;  // change of the last pass, and its ratio to the change before
  for (int pass = 1;; ++pass) {
    const std::optional<double> change = RefineSources(solver, context);
    if (!change) return false;
    const double ratio = before > 0 ? *change / before : 1;
    if (pass == 2) ratio_before = ratio;
    // Two factors alternate, because walls that face each other return each other's light.
    const double by_two = ratio * ratio_before, next = *change * std::max(ratio, ratio_before);
    const bool still = pass > kFewestSourcePasses && by_two > kStill;
    const bool settled = by_two < 1 && next / (1 - std::sqrt(by_two)) <= kSettledShare * options_.error;
    if (settled || still || pass == kMostSourcePasses) return true;
    before = *change;
    ratio_before = ratio;
    const bool shown = pass == 1
                           ? Refine(solver.solution(), options, rough, Rows::kRecord, context).has_value()
                           : ShowAnew(options, context);
    if (!shown) return false;
  }
}

// Gives the samples the present light. False if cancelled.
bool ShownMesh::RelightSamples(const ExecutionContext& context) {
  const PointIrradiance* const now = irradiance_.Get(context);
  if (!now) return false;
  if (samples_are_current_) return true;
  if (samples_.size() > 0)
    report_.counts.sources_renewed += samples_.Relight(samples_from_, *now, Tolerance(), context);
  samples_from_ = now->sources();
  samples_are_current_ = !context.Cancelled();
  return samples_are_current_;
}

// Gives the present mesh the present light. False if cancelled.
bool ShownMesh::ShowAnew(const MeshOptions& options, const ExecutionContext& context) {
  const Stopwatch stopwatch;
  if (!RelightSamples(context)) return false;
  const IrradianceSampler sampler = Sampler(Rows::kRecord, context);
  BuiltMesh built = BuildIrradianceMesh(scene_, triangulations_, {options.order, options.smooth}, sampler,
                                        context, &samples_);
  if (context.Cancelled()) return false;
  mesh_ = std::move(built.mesh);
  triangle_errors_.clear();
  if (observer_) observer_(mesh_);
  report_.counts.point_evaluations += built.point_evaluations;
  report_.seconds.interpolate += stopwatch.Seconds();
  return true;
}

// Gives the means of the interpolants to the leaves and to the cells of leaves whose light varies, and gives
// the samples the new light. Returns the change of the leaves' irradiance (SourceCells::Change); nothing if
// cancelled.
std::optional<double> ShownMesh::RefineSources(LightSolver& solver, const ExecutionContext& context) {
  const Stopwatch stopwatch;
  context.Report("refine sources", 0);
  SourceCells cells = CellsOf(solver.solution(), kFinestScore * options_.error, context);
  if (context.Cancelled()) return std::nullopt;
  const double change = cells.Change();
  const bool done = solver.SetLight(cells.LeafIrradiance(), cells.Fragments(/*whole_leaves=*/false), context);
  irradiance_.Reset();
  samples_are_current_ = false;
  if (done) cells_ = std::move(cells).TakeCells();
  seconds_of_sources_ += stopwatch.Seconds();
  return done ? std::optional(change) : std::nullopt;
}

// Refines the leaves until the error at their triangles' centroids and at random points is at most the
// requested error. False if cancelled before the first mesh was refined.
bool ShownMesh::RefineLeaves(const RadiositySolution& solution, const MeshOptions& options,
                             const ExecutionContext& context) {
  const double error = options_.interpolant_share * options_.error;
  known_.clear();
  if (options_.lookouts > 0) LookAround(options_.lookouts, options_.seed + 1, context);
  std::optional<RefinedMesh> refined = Refine(solution, options, RefinementTo(error), Rows::kNone, context);
  if (!refined) return false;
  double onward = error;
  MeshOptions closer = options;
  for (int turn = 1; refined && turn <= options_.most_turns && refined->share_above <= options_.share_above;
       ++turn) {
    const std::size_t points =
        std::clamp(refined->report.counts.point_evaluations / kEvaluationsALook, kFewestLooks, kMostLooks);
    const double seen = LookAround(points, options_.seed + 1 + static_cast<std::uint64_t>(turn), context);
    if (context.Cancelled() || seen <= kOverlooked * options_.error) return true;
    onward *= std::clamp(kOverlooked * options_.error / seen, kLeastOnward, kMostOnward);
    closer.smooth *= kOnwardSmooth;
    refined = Refine(solution, closer, RefinementTo(onward), Rows::kNone, context);
  }
  if (!refined || onward < error) return true;  // measurements report the rest
  double area = 0;
  for (const ElementId leaf : refined->unmet) area += plan_.forest[leaf].area;
  unmet_ = fmt::format(
      "interpolants: triangles on {:.2g} of the area err by more than {:.3g}; {} leaves of {:.3g} m^2 "
      "together have the smallest area",
      refined->share_above, error, refined->unmet.size(), area);
  return true;
}

// An upper bound of the 99th percentile of the interpolants' error, from `points` random points.
double ShownMesh::LookAround(std::size_t points, std::uint64_t seed, const ExecutionContext& context) {
  const Stopwatch stopwatch;
  const IrradianceSampler sampler = Sampler(Rows::kNone, context);
  const RepresentationError seen =
      MeasureRepresentationError(scene_, mesh_, Remembering(sampler, known_), points, seed);
  report_.counts.point_evaluations += points;
  report_.seconds.interpolate += stopwatch.Seconds();
  return seen.p99_at_most;
}

MeshRefinementOptions ShownMesh::RefinementTo(double error) const {
  MeshRefinementOptions refinement;
  refinement.error = error;
  refinement.share_above = options_.share_above;
  refinement.min_area = options_.solver.min_area;
  refinement.suspicion = options_.suspicion;
  refinement.steep = options_.steep;
  refinement.samples = options_.error_samples;
  refinement.max_rounds = options_.max_rounds;
  return refinement;
}

// Refines the leaves of the present mesh until the interpolants' error is at most `error`, and replaces the
// mesh. Nothing if cancelled; the mesh of the result has been moved from.
std::optional<RefinedMesh> ShownMesh::Refine(const RadiositySolution& solution, const MeshOptions& options,
                                             const MeshRefinementOptions& refinement, Rows rows,
                                             const ExecutionContext& context) {
  const Stopwatch stopwatch;
  if (!RelightSamples(context)) return std::nullopt;
  seconds_of_sources_ += stopwatch.Seconds();
  const IrradianceSampler sampler = Sampler(rows, context);
  RefinedMesh refined = RefineMesh({visibility_, solution, sampler}, options, refinement, context,
                                   {&LocalPass(), &plan_, &samples_, known_, observer_});
  if (context.Cancelled()) samples_.Clear();
  if (context.Cancelled() && refined.mesh.triangles.empty()) return std::nullopt;
  mesh_ = std::move(refined.mesh);
  triangulations_ = std::move(refined.triangulations);
  plan_ = std::move(refined.plan);
  triangle_errors_ = std::move(refined.errors);
  Add(refined.report);
  return refined;
}

}  // namespace penumbra
