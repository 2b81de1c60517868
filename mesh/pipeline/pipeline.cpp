#include "mesh/pipeline/pipeline.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "mesh/interpolants/closer_sources.h"
#include "mesh/interpolants/current_irradiance.h"
#include "mesh/interpolants/mesh_locator.h"
#include "mesh/pipeline/run_limits.h"
#include "mesh/refinement/emitter_interpolants.h"
#include "mesh/refinement/emitter_sources.h"
#include "mesh/refinement/light_operator.h"
#include "mesh/refinement/shown_mesh.h"
#include "solver/base/check.h"
#include "solver/base/stopwatch.h"
#include "solver/transport/points/final_gather.h"
#include "solver/transport/solvers/light_solvers.h"

namespace penumbra {
namespace {

// The tolerance of samples in measurements for details of their sources, as a fraction of the error. The
// tolerance changes results by at most this.
constexpr double kMeasuredShare = 0.1;
// The irradiance that measures sampled light is the mean of this many sets of rays in other directions, which
// also tell its standard error.
constexpr std::size_t kTruthSets = 4;
constexpr std::uint64_t kTruthSeed = 1000;
// The number of random points that measure the sources. If the fraction of values above the requested error
// lies between kClearlyMet and kClearlyMissed, more points are used, because these few cannot tell whether it
// is 1 %.
constexpr std::size_t kFewSourcePoints = 400;
constexpr double kClearlyMet = 0.0025, kClearlyMissed = 0.025;
// Rays for the energy balance, and rays from each patch that search for open sides.
constexpr std::size_t kEnergyRays = std::size_t{1} << 18, kViewRays = 64;
// Random points of CheckErrorRoughly(), which takes 1 % of the time of a solve. The result must be clear for
// so few points.
constexpr std::size_t kGlancePoints = 200;

// The part whose 99th percentile is farthest above the bound; null if none is above. Of a part with few
// points only the lower bound of the percentile counts.
const PartError* WorstPart(std::span<const PartError> parts, double bound) {
  const PartError* worst = nullptr;
  double largest = bound;
  for (const PartError& part : parts) {
    const double error = part.whole.points < kPointsToTellAPart ? part.whole.p99_at_least : part.whole.p99;
    if (error <= largest) continue;
    worst = &part;
    largest = error;
  }
  return worst;
}

// One line about the missed error; `worst` may be null.
std::string MissedError(const PipelineReport& report, const PartError* worst) {
  const RepresentationError& whole = report.whole_error;
  const double shown = std::max(report.interpolant_error.p99, whole.p99);
  std::string line = fmt::format("error: the error asked for, {:g}, was missed: ", report.error_asked);
  if (shown > report.error_asked)
    line += fmt::format("{:.3g} is shown (99th percentile; {:.3g} by interpolating, {:.3g} by the sources); ",
                        shown, report.interpolant_error.p99, report.solution_error_estimate);
  if (worst)
    line += fmt::format("{} errs by {:.3g}, more than {:g} times as much; ", worst->name, worst->whole.p99,
                        kPartError);
  const Vec3& at = whole.worst_point;
  return line + fmt::format("the worst point is ({:.4g}, {:.4g}, {:.4g})", at.x(), at.y(), at.z());
}

// Sampled light errs little: its interpolants may use most of the error on most of the area allowed. A second
// look would only chase noise.
constexpr double kSampledShare = 0.8, kSampledShareAbove = 0.006;
// Without edges along shadows, light may vary within triangles in ways that their vertices do not tell.
constexpr double kSampledSteep = 2;
// A floor of many metres with the shadow of a slat takes more rounds of quartering than a room.
constexpr int kSampledRounds = 16;

ShownMeshOptions HowToShow(const PipelineOptions& options, const ResolvedOptions& resolved) {
  ShownMeshOptions how;
  how.error = options.error;
  how.error_samples = options.error_samples;
  how.seed = options.seed;
  how.solver = resolved.solver;
  if (resolved.solver_name != "sampled") return how;
  how.interpolant_share = kSampledShare;
  how.share_above = kSampledShareAbove;
  how.suspicion = 0;
  how.steep = kSampledSteep;
  how.most_turns = 0;
  how.lookouts = resolved.lookouts;
  how.max_rounds = kSampledRounds;
  return how;
}

// A solver that needs no pairs of patches leaves the pairs of emitters and receivers to the discontinuities.
// Behind more blockers than this, shadows overlap so much that single edges say little.
constexpr std::size_t kMostShadowBlockers = 8;

std::vector<PatchId> Emitters(const Scene& scene) {
  std::vector<PatchId> emitters;
  for (PatchId p = 0; p < static_cast<PatchId>(scene.patches.size()); ++p)
    if ((scene.MaterialOf(p).emittance > 0).any()) emitters.push_back(p);
  return emitters;
}

// The mean of the irradiance of all sets, with its standard error.
PointIrradianceResult MeanOf(std::span<const FinalGather> sets, const ReceiverPoint& at) {
  const auto count = static_cast<double>(sets.size());
  std::vector<Rgb> values;
  PointIrradianceResult mean;
  for (const FinalGather& set : sets) mean.irradiance += values.emplace_back(set.At(at)) / count;
  Rgb squares = Rgb::Zero();
  for (const Rgb& value : values) squares += (value - mean.irradiance).square();
  mean.deviation = (squares / (count * (count - 1))).sqrt();
  return mean;
}

// The roots of the solution's quadtrees, with their mean light.
RadiositySolution RootsOf(const RadiositySolution& solution) {
  RadiositySolution roots;
  const Scene& scene = solution.forest.scene();
  roots.forest = ElementForest(scene);
  roots.rays_per_point = solution.rays_per_point;
  const auto count = static_cast<std::ptrdiff_t>(roots.forest.size());
  const auto beginning = [&](const auto& values) {
    return std::decay_t<decltype(values)>(values.begin(), values.begin() + count);
  };
  roots.irradiance = beginning(solution.irradiance);
  roots.radiosity = beginning(solution.radiosity);
  roots.radiosity_spread = beginning(solution.radiosity_spread);
  roots.spread_below.assign(roots.forest.size(), 0);
  return roots;
}

}  // namespace

struct Pipeline::Impl {
  Impl(const Scene& the_scene, const PipelineOptions& the_options)
      : scene(the_scene),
        options(the_options),
        resolved(Resolve(the_scene, the_options)),
        visibility(PatchVisibility::WithoutPairs(the_scene)),
        irradiance([this](const ExecutionContext& context) { return MakeIrradiance(context); }),
        shown(scene, visibility, irradiance, HowToShow(options, resolved)) {
    options.solver = resolved.solver_name;
  }

  const Scene& scene;
  PipelineOptions options;
  ResolvedOptions resolved;
  PatchVisibility visibility;
  std::unique_ptr<LightSolver> solver;                // null until Link()
  std::optional<RunLimits::Clock::time_point> begun;  // start of Solve(), from which its limits count
  std::optional<RadiositySolution> stored;            // another pipeline's result, until a step restarts
  std::optional<RadiositySolution> undivided;         // RootsOf(Solution()), if it has been needed
  std::optional<MeshKind> mesh_kind;                  // of the mesh of the present solution
  bool mesh_unrefined = false;                        // because refinement was not requested
  bool light_refined = false;                         // RefineLight() has been completed for this light
  std::unique_ptr<MeshLocator> locator;
  PipelineReport report;
  CurrentIrradiance irradiance;  // from the present solution
  ShownMesh shown;
  std::optional<LightOperator> light_operator;  // of the present solution and mesh
  std::vector<EmitterLight> emitters;  // of the present solution; without interpolants before BuildMesh()

  // A new solver, and the seconds that finding pairs and making the solver have taken.
  struct NewSolver {
    std::unique_ptr<LightSolver> solver;
    double pairs = 0, making = 0;
  };

  // Makes a solver, which continues from a solution if one is given; null if the method cannot continue.
  NewSolver MakeSolver(RadiositySolution* from, const ExecutionContext& context) {
    NewSolver made;
    const Stopwatch stopwatch;
    bool has_pairs = from != nullptr;
    const auto pairs = [&](const ExecutionContext& finding) -> const PatchVisibility& {
      const Stopwatch seconds;
      if (!has_pairs) visibility = PatchVisibility(scene, finding);
      has_pairs = true;
      made.pairs = seconds.Seconds();
      return visibility;
    };
    DenseOptions dense = options.dense;
    dense.keep_matrix = options.by_emitter;
    made.solver = LightSolvers().Make(resolved.solver_name, {scene, pairs, from},
                                      {resolved.solver, dense, resolved.sampled, resolved.uniform}, context);
    made.making = stopwatch.Seconds() - made.pairs;
    if (has_pairs || !made.solver) return made;
    const Stopwatch seconds;
    visibility = PatchVisibility::OfSources(scene, Emitters(scene), kMostShadowBlockers, context);
    made.pairs = seconds.Seconds();
    return made;
  }

  void Adopt(NewSolver made) {
    solver = std::move(made.solver);
    AddPhase("link", made.pairs);
    // A solver that solves in its constructor has no steps left.
    AddPhase(solver->Ready() && !solver->Next() ? "iterate" : "link", made.making);
    TakeReport();
    Count();
  }

  void TakeReport() {
    report.iterations = solver->report().iterations;
    report.dense = solver->report().dense;
    report.begun = solver->report().begun;
  }

  // Adds the seconds to the phase of this name.
  void AddPhase(const std::string& name, double seconds) {
    const auto phase = std::find_if(report.phases.begin(), report.phases.end(),
                                    [&](const Phase& p) { return p.name == name; });
    if (phase == report.phases.end())
      report.phases.push_back({name, seconds});
    else
      phase->seconds += seconds;
  }

  const RadiositySolution& Solution() const {
    PENUMBRA_CHECK(solver != nullptr || stored);
    return stored ? *stored : solver->solution();
  }

  // The solution whose leaves are divided to a mesh of this kind. Points of a sampled solution gather anew,
  // so that interpolants begin with whole patches: its elements are small for the sake of other places.
  const RadiositySolution& SolutionToShow(MeshKind kind) {
    const RadiositySolution& solution = Solution();
    if (solution.rays_per_point == 0 || kind == MeshKind::kFlat || kind == MeshKind::kGouraud)
      return solution;
    if (!undivided) undivided = RootsOf(solution);
    return *undivided;
  }

  // Null if cancelled.
  std::unique_ptr<const PointIrradiance> MakeIrradiance(const ExecutionContext& context) {
    return MakeIrradiance(Solution(), context);
  }
  // From a solution with the same elements.
  std::unique_ptr<const PointIrradiance> MakeIrradiance(const RadiositySolution& solution,
                                                        const ExecutionContext& context) {
    const std::shared_ptr<const LeafVisibility> leaves = solver ? solver->SeenFromLeaves(context) : nullptr;
    if (solver && !leaves) return nullptr;
    PointIrradianceOptions how = options.point;
    if (solver) how.part_of_tolerance = solver->PartOfTolerance();
    if (!how.method) how.method = resolved.occlusion.get();
    return std::make_unique<PointIrradiance>(solution, visibility, how, leaves);
  }

  // True if the light of each emitter is to be found, and the options permit it: corrections that cut leaves
  // would cut them differently for each emitter, and other occlusion methods give no rows.
  bool Splits() const {
    return options.by_emitter && solver && !options.source_error && !options.point.method &&
           !resolved.occlusion && options.point.min_backprojection_segment <= 0;
  }

  // Finds the light of each emitter on the present sources, and makes their sum the whole light.
  void SplitLight(const ExecutionContext& context) {
    const std::vector<std::vector<PatchId>> all = EmittersOf(scene, options.emitter_unit);
    if (!Splits() || !emitters.empty() || all.empty()) return;
    const Stopwatch stopwatch;
    const bool by_mesh = resolved.refine_light && solver->TakesLight();
    std::optional<std::vector<EmitterLight>> lights;
    if (!by_mesh)
      lights = SolveByEmitter(*solver, all, nullptr, context);
    else if (light_refined)
      lights = shown.SplitLight(*solver, all, OptionsOf(MeshKind::kInterpolant), context);
    if (lights) {
      const EmitterLight sum = SumOf(*lights, std::vector<Rgb>(lights->size(), Rgb::Ones()));
      solver->ReplaceLight(sum.element, sum.fragment);
      emitters = std::move(*lights);
      undivided.reset();
      irradiance.Reset();
    }
    shown.TakeNewLight();
    AddPhase("iterate", stopwatch.Seconds());
  }

  // Finds the interpolants of each emitter on the present mesh, and makes their sum the interpolants of the
  // mesh.
  void SplitInterpolants(const ExecutionContext& context) {
    if (emitters.empty()) return;
    const Stopwatch stopwatch;
    const PointIrradiance* const exact = irradiance.Get(context);
    const auto of_solution = [&](const RadiositySolution& alone) { return MakeIrradiance(alone, context); };
    const std::size_t evaluations = exact ? InterpolateByEmitter({Solution(), shown.triangulations(), *exact,
                                                                  of_solution, shown.EmitterTolerance()},
                                                                 emitters, context)
                                          : 0;
    if (evaluations == 0)
      emitters.clear();
    else
      shown.SetInterpolants(SumOf(emitters, std::vector<Rgb>(emitters.size(), Rgb::Ones())).interpolant);
    report.counts.point_evaluations += evaluations;
    AddPhase("interpolate", stopwatch.Seconds());
  }

  // Says why there is no light by emitter, if that was asked for.
  void TellUnsplit() {
    DropUnmet("emitters: ");
    if (!options.by_emitter || !emitters.empty() || EmittersOf(scene, options.emitter_unit).empty()) return;
    report.unmet.push_back(Splits() ? "emitters: the light of each is not kept: the work ended before it"
                                    : "emitters: the light of each is not kept: other options exclude it");
  }

  void BeginLimits() { begun = options.limits_from.value_or(RunLimits::Clock::now()); }
  // The rest of Solve()'s limits; no limits without Solve().
  RunLimits LimitsSinceSolve(const ExecutionContext& context) const {
    return RunLimits(context, begun ? options.time_limit : std::nullopt,
                     begun ? options.memory_limit : std::nullopt, begun.value_or(RunLimits::Clock::now()),
                     options.memory_kept);
  }

  // True if the measurement was ended early; then removes incomplete results from the report.
  bool EndedMeasuring(const RunLimits& limits) {
    if (!limits.context().Cancelled()) return false;
    report.interpolant_error = report.whole_error = {};
    report.part_errors.clear();
    report.solution_error_estimate = 0;
    report.error_met = false;
    if (const std::optional<std::string> limit = limits.Exceeded())
      report.unmet.push_back(fmt::format("error: not measured, ended by {}", *limit));
    return true;
  }

  MeshOptions OptionsOf(MeshKind kind) const {
    MeshOptions mesh_options;
    mesh_options.discontinuities = resolved.discontinuities;
    if (kind != MeshKind::kGouraudMesh && kind != MeshKind::kInterpolant)
      mesh_options.discontinuities.choice = kNoDiscontinuities;
    mesh_options.order = kind == MeshKind::kFlat          ? InterpolantOrder::kConstant
                         : kind == MeshKind::kInterpolant ? InterpolantOrder::kQuadratic
                                                          : InterpolantOrder::kLinear;
    return mesh_options;
  }

  // Makes the mesh of this kind from the present solution. Refines the leaves of kInterpolant, unless
  // cancelled or not requested. False if cancelled before there was a mesh.
  bool MakeMesh(MeshKind kind, const ExecutionContext& context, bool as_it_is) {
    const bool refines =
        kind == MeshKind::kInterpolant && solver && options.refine != RefineBy::kTransport && !as_it_is;
    const RadiositySolution& solution = SolutionToShow(kind);
    return refines ? shown.MakeRefined(solution, OptionsOf(kind), context)
                   : shown.Make(solution, OptionsOf(kind), context);
  }

  // Ends a complete or incomplete step of the solver that took `seconds`. If the light `changed`, discards
  // the results from the earlier light.
  void EndStep(double seconds, bool changed) {
    if (changed) Forget();
    AddPhase("iterate", seconds);
    TakeReport();
    Count();
  }

  // Reports what the iterations have not achieved.
  void TellUnmetIterations() {
    if (solver->report().full)
      report.unmet.push_back(
          fmt::format("iterate: links are not refined to the end: they would be more than {} million",
                      resolved.solver.max_links / 1'000'000));
    const double residual = report.iterations.empty() ? INFINITY : report.iterations.back().residual;
    if (!solver->Converged() && solver->Next() != SolverStep::kIterate)
      report.unmet.push_back(fmt::format("iterate: {} iterations left a residual of {:.2g}",
                                         report.iterations.size(), residual));
  }

  // Adds the time for meshes since the last call.
  void AddMeshPhases() {
    const MeshSeconds seconds = shown.TakeSeconds();
    if (seconds.sources > 0) AddPhase("iterate", seconds.sources);
    AddPhase("discontinuities", seconds.mesh.discontinuities);
    AddPhase("triangulate", seconds.mesh.triangulate);
    AddPhase("interpolate", seconds.mesh.interpolate);
  }

  // Irradiance that is closer to the truth than that of the solution, to measure its error.
  struct Truths {
    std::vector<std::shared_ptr<const void>> owned;  // what the samplers refer to
    std::vector<IrradianceSampler> samplers;
  };

  // Gathers with rays in directions that differ from those of the solution's points, and from set to set.
  std::vector<FinalGather> TruthSets() {
    std::vector<FinalGather> sets;
    for (std::size_t k = 0; k < kTruthSets; ++k) {
      FinalGatherOptions how;
      how.rays = Solution().rays_per_point;
      how.seed = kTruthSeed + kTruthSets * options.seed + k;
      how.regather = true;
      how.shadows.seed = how.seed;
      if (sets.empty())
        sets.emplace_back(Solution(), how);
      else
        sets.push_back(sets.front().With(how));
    }
    return sets;
  }

  // No samplers if cancelled. `context` must outlive the result.
  Truths BetterLight(const ExecutionContext& context) {
    Truths truths;
    if (Solution().rays_per_point > 0) {
      const auto sets = std::make_shared<const std::vector<FinalGather>>(TruthSets());
      truths.owned = {sets};
      truths.samplers = {WhileGoing(
          [sets = sets.get()](PatchId, const ReceiverPoint& at) { return MeanOf(*sets, at); }, context)};
      return truths;
    }
    const SourceCells finest = shown.FinestCells(Solution(), context);
    if (context.Cancelled()) return truths;
    const std::shared_ptr<const PointIrradiance> better = shown.BetterIrradiance(Solution(), finest, context);
    if (!better) return truths;
    const std::shared_ptr<const PointIrradiance> from_shown = shown.ShownIrradiance(Solution(), finest);
    const double tolerance = kMeasuredShare * options.error;
    truths.owned = {better, from_shown};
    truths.samplers = {WhileGoing(NearSampler(*better, tolerance), context),
                       WhileGoing(NearSampler(*from_shown, tolerance), context)};
    return truths;
  }

  // Removes the stage's earlier messages; a repeated failure is reported again.
  void DropUnmet(std::string_view stage) {
    std::erase_if(report.unmet, [&](const std::string& line) { return line.starts_with(stage); });
  }

  // Discards the results from an earlier solution.
  void Forget() {
    irradiance.Reset();
    undivided.reset();
    emitters.clear();
    light_operator.reset();
    shown.Forget();
    mesh_kind.reset();
    light_refined = false;
  }

  // Returns the other pipeline's solution, for a step that continues from it or discards it, and clears the
  // report.
  RadiositySolution TakeStored() {
    RadiositySolution solution = std::move(*stored);
    stored.reset();
    Forget();
    report = {};
    report.error_asked = options.error;
    return solution;
  }

  void Count() {
    const RadiositySolution& solution = Solution();
    PipelineReport::Counts& counts = report.counts;
    counts.patches = scene.patches.size();
    counts.emitters = 0;
    for (const Patch& patch : scene.patches)
      counts.emitters += (scene.materials[patch.material].emittance > 0).any() ? 1 : 0;
    counts.elements = solution.forest.size();
    counts.leaves = 0;
    for (const Element& element : solution.forest.elements()) counts.leaves += element.IsLeaf() ? 1 : 0;
    counts.links = solution.links.links.size();
    counts.links_visible = counts.links_partial = 0;
    for (const penumbra::Link& link : solution.links.links)
      ++(link.visibility == Visibility::kVisible ? counts.links_visible : counts.links_partial);
    report.interactions = solver ? solver->report().interactions : InteractionCounts();
    report.interactions.smooth += counts.links_visible;
    report.interactions.sharp += counts.links_partial;
  }
};

Pipeline::Pipeline(const Scene& scene, const PipelineOptions& options) : impl_(new Impl(scene, options)) {
  impl_->report.error_asked = options.error;
}

Pipeline::Pipeline(const Scene& scene, const PipelineOptions& options, PipelineState state)
    : impl_(new Impl(scene, options)) {
  impl_->visibility = std::move(state.visibility);
  impl_->stored = std::move(state.solution);
  impl_->mesh_kind = state.mesh_kind;
  impl_->shown.Take(std::move(state.mesh));
  impl_->emitters = std::move(state.emitters);
  impl_->locator = std::make_unique<MeshLocator>(scene, impl_->shown.mesh());
  impl_->report = std::move(state.report);
}

Pipeline::~Pipeline() = default;

void Pipeline::Link(const ExecutionContext& context) {
  if (impl_->solver && impl_->solver->Ready()) return;
  context.Report("link", 0);
  if (impl_->stored) impl_->TakeStored();
  impl_->shown.ForgetVisibility();
  if (impl_->solver) impl_->Forget();  // of a cancelled linking
  impl_->Adopt(impl_->MakeSolver(nullptr, context));
}

bool Pipeline::Step(SolverStep step, const ExecutionContext& context) {
  Link(context);
  const Stopwatch stopwatch;
  const bool done = impl_->solver->Step(step, context);
  // A cancelled correction may have made some passes.
  impl_->EndStep(stopwatch.Seconds(), done || (step == SolverStep::kCorrect && context.Cancelled()));
  return done;
}

std::optional<IterationReport> Pipeline::Iterate(const ExecutionContext& context) {
  const std::size_t before = impl_->report.iterations.size();
  if (!Step(SolverStep::kIterate, context) || impl_->report.iterations.size() == before) return std::nullopt;
  return impl_->report.iterations.back();
}

bool Pipeline::Converged() const { return impl_->solver && impl_->solver->Converged(); }

std::optional<SolverStep> Pipeline::NextStep() const {
  return impl_->solver ? impl_->solver->Next() : std::nullopt;
}

std::optional<SolverStep> Pipeline::NextSmallStep() const {
  return impl_->solver ? impl_->solver->NextSmall() : std::nullopt;
}

std::unique_ptr<Pipeline> Pipeline::Branch() const {
  if (!impl_->solver || impl_->stored) return nullptr;
  auto branch = std::make_unique<Pipeline>(impl_->scene, impl_->options);
  branch->impl_->visibility = impl_->visibility;
  branch->impl_->solver = impl_->solver->Copy(branch->impl_->visibility);
  if (!branch->impl_->solver) return nullptr;
  const auto of_solver = [](const std::string& name) {
    return name == "load" || name == "link" || name == "iterate";
  };
  PipelineReport& report = branch->impl_->report;
  for (const Phase& phase : impl_->report.phases)
    if (of_solver(phase.name)) report.phases.push_back(phase);
  for (const std::string& line : impl_->report.unmet)
    if (of_solver(line.substr(0, line.find(':')))) report.unmet.push_back(line);
  branch->impl_->begun = impl_->begun;
  branch->impl_->TakeReport();
  branch->impl_->Count();
  return branch;
}

std::optional<IterationReport> Pipeline::Relight(const ExecutionContext& context) {
  if (impl_->stored) {
    // Continuing takes no form factors, and is not cancelled: corrections would be those of other links.
    Impl::NewSolver made = impl_->MakeSolver(&*impl_->stored, ExecutionContext());
    if (!made.solver) return std::nullopt;
    impl_->TakeStored();
    impl_->Adopt(std::move(made));
  }
  Link(context);
  const Stopwatch stopwatch;
  const bool done = impl_->solver->Relight(context);
  impl_->EndStep(stopwatch.Seconds(), done);
  return done ? std::optional(impl_->report.iterations.back()) : std::nullopt;
}

void Pipeline::SolveOverLinks(const ExecutionContext& context) {
  impl_->BeginLimits();
  for (const char* stage : {"link: ", "iterate: "}) impl_->DropUnmet(stage);
  const RunLimits limits = impl_->LimitsSinceSolve(context);
  const ExecutionContext& running = limits.context();
  running.Report("iterate", 0);
  const std::optional<IterationReport> relit = Relight(running);
  if (relit && relit->residual > impl_->resolved.solver.relative_cutoff)
    impl_->report.unmet.push_back(fmt::format("iterate: {} sweeps over the links left a residual of {:.2g}",
                                              relit->sweeps, relit->residual));
  const bool corrected = relit && Correct(running);
  if (const std::optional<std::string> limit = limits.Exceeded(); limit && !corrected)
    impl_->report.unmet.push_back(fmt::format("iterate: ended by {}, {} and not corrected to the end", *limit,
                                              relit ? "lit anew" : "with the light of before"));
}

void Pipeline::Solve(const ExecutionContext& context, const StepObserver& observer) {
  impl_->BeginLimits();
  for (const char* stage : {"link: ", "iterate: "}) impl_->DropUnmet(stage);
  const RunLimits limits = impl_->LimitsSinceSolve(context);
  const ExecutionContext& running = limits.context();
  Link(running);
  LightSolver& solver = *impl_->solver;
  if (!solver.Ready()) {
    if (const std::optional<std::string> limit = limits.Exceeded())
      impl_->report.unmet.push_back(
          fmt::format("link: ended by {}: nothing is linked, and dark but for what it emits", *limit));
    return;
  }
  Stopwatch stopwatch;
  const bool whole = SolveStepByStep(solver, running, [&](SolverStep step) {
    impl_->EndStep(stopwatch.Seconds(), true);
    if (observer) observer(step);
    stopwatch = Stopwatch();
  });
  if (!whole) impl_->EndStep(stopwatch.Seconds(), true);
  impl_->TellUnmetIterations();
  const std::vector<IterationReport>& iterations = impl_->report.iterations;
  if (const std::optional<std::string> limit = limits.Exceeded(); limit && !whole)
    impl_->report.unmet.push_back(
        fmt::format("iterate: ended by {} after {} iterations, {} and not corrected to the end", *limit,
                    iterations.size(), Converged() ? "converged" : "not converged"));
}

bool Pipeline::KeepOperator(const ExecutionContext& context) {
  PENUMBRA_CHECK(impl_->shown.triangulations().size() == impl_->scene.patches.size() &&
                 impl_->mesh_kind == MeshKind::kInterpolant);
  const PointIrradiance* const exact = impl_->irradiance.Get(context);
  if (!exact || !exact->CanRecord()) return false;
  impl_->light_operator.emplace(
      OperatorInput{solution(), impl_->shown.forest(), impl_->shown.triangulations(), *exact, impl_->emitters,
                    impl_->shown.EmitterTolerance()},
      context);
  if (!impl_->light_operator->Ready()) impl_->light_operator.reset();
  return impl_->light_operator.has_value();
}

std::size_t Pipeline::OperatorBytes() const {
  return impl_->light_operator ? impl_->light_operator->bytes() : 0;
}

std::optional<PipelineState> Pipeline::LitBy(const Scene& other) const {
  if (!impl_->light_operator) return std::nullopt;
  std::optional<EmitterLight> light =
      impl_->light_operator->LitBy(other, impl_->resolved.solver.relative_cutoff);
  if (!light) return std::nullopt;
  PipelineState state;
  state.visibility = visibility();
  state.solution = solution();
  state.solution.forest = state.solution.forest.Of(other);
  ReplaceIrradiance(light->element, light->fragment, state.solution);
  state.mesh = mesh();
  state.mesh.irradiance = std::move(light->interpolant);
  state.report.counts = impl_->report.counts;
  state.report.interactions = impl_->report.interactions;
  state.report.iterations = impl_->report.iterations;
  state.report.error_asked = impl_->report.error_asked;
  return state;
}

void Pipeline::ObserveMesh(MeshObserver observer) { impl_->shown.Observe(std::move(observer)); }

void Pipeline::CountLimits() { impl_->begun = RunLimits::Clock::now(); }

bool Pipeline::RefinesLight() const {
  return impl_->resolved.refine_light && impl_->solver && impl_->solver->TakesLight();
}

bool Pipeline::LightIsRefined() const { return impl_->light_refined; }

void Pipeline::RefineLight(const ExecutionContext& context) {
  if (!RefinesLight()) return;
  if (impl_->light_refined) return;
  const RunLimits limits = impl_->LimitsSinceSolve(context);
  impl_->light_operator.reset();
  impl_->light_refined =
      impl_->shown.RefineLight(*impl_->solver, impl_->OptionsOf(MeshKind::kInterpolant), limits.context());
  impl_->DropUnmet("light: ");
  if (const std::optional<std::string> limit = limits.Exceeded(); limit && !impl_->light_refined)
    impl_->report.unmet.push_back(fmt::format("light: ended by {}, and not refined to the end", *limit));
  impl_->mesh_kind.reset();
  impl_->locator.reset();
  impl_->AddMeshPhases();
  impl_->SplitLight(limits.context());
}

void Pipeline::BuildMesh(MeshKind kind, const ExecutionContext& context, bool as_it_is) {
  if (impl_->mesh_kind == kind && (as_it_is || !impl_->mesh_unrefined)) return;
  const RunLimits limits = impl_->LimitsSinceSolve(context);
  impl_->light_operator.reset();
  if (!impl_->stored)
    for (const char* stage : {"mesh: ", "discontinuities: ", "interpolants: "}) impl_->DropUnmet(stage);
  // A mesh without irradiance at points is quick to make, so that limits do not apply.
  const bool flat = kind == MeshKind::kFlat;
  MeshKind made = kind;
  const bool splits = impl_->Splits() && kind == MeshKind::kInterpolant && !as_it_is;
  if (splits) impl_->SplitLight(limits.context());
  if (!impl_->MakeMesh(kind, flat ? context : limits.context(), as_it_is) && !flat && !context.Cancelled()) {
    made = MeshKind::kFlat;
    impl_->MakeMesh(made, context, as_it_is);
  }
  if (impl_->shown.unmet()) impl_->report.unmet.push_back(*impl_->shown.unmet());
  if (const std::optional<std::string> limit = limits.Exceeded(); limit && !flat)
    impl_->report.unmet.push_back(
        fmt::format("mesh: ended by {}, {}", *limit,
                    made == kind ? "and not refined to the end by what is shown"
                                 : "before there were interpolants: leaves show their mean"));
  impl_->mesh_kind = context.Cancelled() ? std::nullopt : std::optional(made);
  impl_->mesh_unrefined = as_it_is;

  impl_->AddMeshPhases();
  const MeshReport& report = impl_->shown.report();
  PipelineReport::Counts& counts = impl_->report.counts;
  counts.discontinuities = report.counts.discontinuities;
  counts.dsets_active = report.counts.dsets_active;
  counts.most_merged = report.counts.most_merged;
  counts.triangles = report.counts.triangles;
  counts.interpolants = report.counts.interpolants;
  counts.point_evaluations = report.counts.point_evaluations;
  counts.sources_renewed = report.counts.sources_renewed;
  if (splits && made == kind) impl_->SplitInterpolants(limits.context());
  impl_->locator = std::make_unique<MeshLocator>(impl_->scene, impl_->shown.mesh());
  if (kind == MeshKind::kInterpolant && !as_it_is && !impl_->stored) impl_->TellUnsplit();
  if (report.counts.refused_contacts > 0)
    impl_->report.unmet.push_back(
        fmt::format("discontinuities: {} contact edges left out, since a leaf would have more "
                    "than {} discontinuity edges",
                    report.counts.refused_contacts, impl_->resolved.discontinuities.max_leaf_dsets));
}

void Pipeline::Diagnose(const ExecutionContext& context) {
  PENUMBRA_CHECK(impl_->locator != nullptr);
  PipelineReport& report = impl_->report;
  const EnergyBalance energy = MeasureEnergy(solution(), kEnergyRays, 1, context);
  LinkDiagnostics links = DiagnoseLinks(solution(), context);
  ViewDiagnostics views = DiagnoseViews(impl_->scene, kViewRays, 1, context);
  if (context.Cancelled()) return;
  report.energy = energy;
  if (solution().links.links.empty()) {
    links.closure_min = views.fronts_min;
    links.closure_max = views.fronts_max;
    links.closure_mean = views.fronts_mean;
    links.covered_area = views.covered_area;
  }
  report.links = std::move(links);
  report.views = std::move(views);
  report.quality = MeasureQuality(impl_->shown.mesh());
  if (impl_->solver) report.bounces = impl_->solver->MeanIrradianceByBounce(impl_->options.bounces);
  report.warnings.clear();
  // For a scene that is turned inside out as a whole, the reader has already warned.
  if (!report.views.reversed_faces.empty() && !FindLitSides(impl_->scene).TurnedInsideOut())
    report.warnings.push_back(fmt::format(
        "{}: warning: the fronts of {} faces see nothing but backs, the first is face {} (counted "
        "from 0); if it is reversed, give its vertices in the other order",
        impl_->scene.name, report.views.reversed_faces.size(), report.views.reversed_faces[0]));
}

void Pipeline::Measure(const ExecutionContext& context) {
  PENUMBRA_CHECK(impl_->shown.triangulations().size() == impl_->scene.patches.size());
  context.Report("measure", 0);
  const RunLimits limits = impl_->LimitsSinceSolve(context);
  const ExecutionContext& running = limits.context();
  Diagnose(running);
  impl_->DropUnmet("error: ");
  PipelineReport& report = impl_->report;
  report.interpolant_error = report.whole_error = {};
  report.part_errors.clear();
  report.solution_error_estimate = 0;
  const auto ended = [&] { return impl_->EndedMeasuring(limits); };
  if (ended() || (impl_->solver && !impl_->solver->SeenFromLeaves(running) && ended())) return;
  const std::size_t points = impl_->options.error_points;
  if (points == 0) {
    report.error_met = false;
    report.unmet.push_back("error: not measured, since no points were asked for");
    return;
  }
  const std::uint64_t seed = impl_->options.seed;
  const IrradianceMesh& mesh = impl_->shown.mesh();
  const Impl::Truths truths = impl_->BetterLight(running);
  if (ended()) return;
  const IrradianceSampler sampler =
      WhileGoing(NearSampler(irradiance(), kMeasuredShare * report.error_asked), running);
  const auto measure = [&](std::size_t at) {
    return MeasureError(impl_->scene, mesh, sampler, truths.samplers, {at, seed, report.error_asked});
  };
  MeasuredError error = measure(std::min(points, kFewSourcePoints));
  if (points > kFewSourcePoints && error.above > kClearlyMet && error.above < kClearlyMissed)
    error = measure(points);
  report.interpolant_error = error.interpolant.points == points
                                 ? error.interpolant
                                 : MeasureRepresentationError(impl_->scene, mesh, sampler, points, seed);
  if (ended()) return;
  report.solution_error_estimate = error.sources.p99;
  report.whole_error = error.whole;
  report.part_errors = std::move(error.by_part);
  const PartError* worst = WorstPart(report.part_errors, kPartError * report.error_asked);
  report.error_met = !worst && std::max(report.interpolant_error.p99, error.whole.p99) <= report.error_asked;
  if (!report.error_met) report.unmet.push_back(MissedError(report, worst));
}

void Pipeline::CheckErrorRoughly(const ExecutionContext& context) {
  PENUMBRA_CHECK(impl_->mesh_kind.has_value());
  const RunLimits limits = impl_->LimitsSinceSolve(context);
  const bool can_tell =
      impl_->solver && (impl_->solver->TakesLight() || impl_->Solution().rays_per_point > 0);
  if (*impl_->mesh_kind != MeshKind::kInterpolant || !can_tell || limits.context().Cancelled() ||
      !impl_->solver->SeenFromLeaves(limits.context()))
    return;
  context.Report("measure", 0);
  PipelineReport& report = impl_->report;
  const Impl::Truths truths = impl_->BetterLight(limits.context());
  if (truths.samplers.empty()) return;
  const RepresentationError seen =
      MeasureRepresentationError(impl_->scene, impl_->shown.mesh(), truths.samplers[0],
                                 std::min(impl_->options.error_points, kGlancePoints), impl_->options.seed);
  impl_->DropUnmet("error: ");
  if (seen.p99_at_least > report.error_asked)
    report.unmet.push_back(fmt::format(
        "error: the error asked for, {:g}, was missed: {:.3g} is shown (99th percentile at {} points; a "
        "report tells more)",
        report.error_asked, seen.p99, seen.points));
}

void Pipeline::SetErrorPoints(std::size_t points) { impl_->options.error_points = points; }

const Scene& Pipeline::scene() const { return impl_->scene; }
const PipelineOptions& Pipeline::options() const { return impl_->options; }
const ResolvedOptions& Pipeline::resolved() const { return impl_->resolved; }
const RadiositySolution& Pipeline::solution() const { return impl_->Solution(); }
const PatchVisibility& Pipeline::visibility() const { return impl_->visibility; }
const PointIrradiance& Pipeline::irradiance() const { return *impl_->irradiance.Get(); }
const IrradianceMesh& Pipeline::mesh() const { return impl_->shown.mesh(); }
std::optional<MeshKind> Pipeline::mesh_kind() const { return impl_->mesh_kind; }
std::span<const EmitterLight> Pipeline::emitters() const {
  const bool complete = !impl_->emitters.empty() && !impl_->emitters[0].interpolant.empty();
  return complete ? std::span<const EmitterLight>(impl_->emitters) : std::span<const EmitterLight>();
}
std::span<const TriangleError> Pipeline::triangle_errors() const { return impl_->shown.triangle_errors(); }
const PipelineReport& Pipeline::report() const { return impl_->report; }

DiscontinuityList Pipeline::Discontinuities() const {
  const ExecutionContext context;
  const RunLimits limits = impl_->LimitsSinceSolve(context);
  return ListDiscontinuities(solution(), visibility(), resolved().discontinuities, limits.context());
}

std::optional<Rgb> Pipeline::Interpolated(PatchId patch, const Vec3& point, double reach) const {
  PENUMBRA_CHECK(impl_->locator != nullptr);
  const auto location = impl_->locator->Find(patch, point, reach);
  if (!location) return std::nullopt;
  return Rgb(IrradianceAt(impl_->shown.mesh(), *location).max(0.0));
}

PointIrradianceResult Pipeline::IrradianceInSpace(const PointIrradiance& irradiance, const ReceiverPoint& at,
                                                  IrradianceParts* parts) const {
  const bool is_light_of_mesh = impl_->mesh_kind == MeshKind::kInterpolant && impl_->resolved.refine_light &&
                                impl_->resolved.solver_name == PipelineOptions().SolverName() &&
                                !irradiance.IsSampled();
  // The choice of divisions depends on the light: lamps that are dimmed one by one would not add up.
  if (!is_light_of_mesh || impl_->options.by_emitter) return irradiance.Anywhere(at, parts);
  const CloserSources closer(
      impl_->Solution(), irradiance.sources(),
      [this](PatchId patch, const Vec3& point) { return Interpolated(patch, point); }, impl_->options.error);
  const std::optional<DividedSources> divided = closer.At(at);
  return irradiance.Anywhere(at, parts, divided ? &*divided : nullptr);
}

}  // namespace penumbra
