#include "mesh/pipeline.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string_view>

#include <fmt/format.h>

#include "mesh/local_pass.h"
#include "mesh/mesh_locator.h"
#include "mesh/mesh_refinement.h"
#include "mesh/run_limits.h"
#include "mesh/source_cells.h"
#include "mesh/source_cut.h"
#include "solver/base/check.h"
#include "solver/base/stopwatch.h"

namespace penumbra {
namespace {

// The shares of the error that the interpolants and their sources may make, each at its 99th percentile:
// seldom both at one point.
constexpr double kInterpolantShare = 0.65, kSourceShare = 0.25;
// What interpolants' samples may leave out of their sources' detail, as a share of the error. Those of the
// looks before the last keep to SolverOptions::correction_tolerance: their means correct the sources' light,
// so that what is off in all of them grows from bounce to bounce.
constexpr double kNearShare = 0.2;
// The same of the samples that measure: what they leave out moves the figures by no more.
constexpr double kMeasuredShare = 0.02;
// Looks before the last, which only sources are made of, take edges of this times the least weight.
constexpr double kFirstWeight = 2;
// Sources are refined again while their means will change by more than this share of the error, so many
// times: two to four in most rooms, and twenty in a narrow slot between white walls, where light goes to and
// fro. They end sooner where two passes leave more than this of a change. The first choose how finely.
constexpr double kSettledShare = 0.6, kStill = 0.95;
constexpr int kMostSourcePasses = 40, kCutChoices = 2;
// Centroids can overlook what random points see. Once the mesh is refined these look, one for so many
// evaluations of the refinement, and while one in a hundred errs by more than this share of the error it is
// refined on, towards this of what was asked before.
constexpr std::size_t kEvaluationsALook = 20, kFewestLooks = 1000, kMostLooks = 3000;
constexpr double kOverlooked = 0.8, kOnward = 0.6;
constexpr int kMostTurns = 3;
// Cells of sources are divided while their score is above this times the error.
constexpr double kFinestScore = 1;
// Random points that choose the sources, and that measure them. More measure them where the share of values
// that err by more than was asked is between these: where so few cannot tell whether it is 1 %.
constexpr std::size_t kCutPoints = 300, kFewSourcePoints = 400;
constexpr double kClearlyMet = 0.0025, kClearlyMissed = 0.025;

}  // namespace

struct Pipeline::Impl {
  Impl(const Scene& the_scene, const PipelineOptions& the_options)
      : scene(the_scene), options(the_options), resolved(Resolve(the_scene, the_options)) {}

  const Scene& scene;
  PipelineOptions options;
  ResolvedOptions resolved;
  PatchVisibility visibility;
  std::unique_ptr<HierarchicalSolver> solver;         // null until the roots are linked
  std::optional<RunLimits::Clock::time_point> begun;  // when Solve() did: its limits count from there
  std::optional<RadiositySolution> stored;            // that another one made, until a step begins anew
  std::optional<MeshKind> mesh_kind;                  // of a mesh of the present solution
  bool mesh_unrefined = false;                        // for that was not asked for then
  IrradianceMesh mesh;
  std::unique_ptr<LocalPassCache> local_pass;      // of the present visibility
  std::vector<PatchTriangulation> triangulations;  // of the mesh
  ElementForest mesh_forest;                       // whose leaves they are
  std::vector<TriangleError> triangle_errors;      // of the mesh, where they were measured
  std::unique_ptr<MeshLocator> locator;
  PipelineReport report;
  std::mutex irradiance_making;
  std::unique_ptr<PointIrradiance> irradiance;  // of the present solution; null until someone asks

  // What is cancelled leaves no solver.
  void SolveDenseSystem(const ExecutionContext& context) {
    const Stopwatch stopwatch;
    const ElementForest forest = UniformForest(scene, options.divisions);
    const std::size_t unknowns = CountUnknowns(forest, options.dense->degree);
    if (unknowns > kMostDenseUnknowns)
      throw InputError(
          fmt::format("{}:0: error: the dense solver would have {} unknowns and can take {}; ask for "
                      "fewer divisions or a basis of lower degree",
                      scene.name, unknowns, kMostDenseUnknowns));
    const DenseSystem system = AssembleDense(forest, visibility, *options.dense, context);
    if (context.Cancelled()) return;
    solver = std::make_unique<HierarchicalSolver>(scene, visibility, resolved.solver,
                                                  ToRadiositySolution(system, SolveDense(system)));
    report.dense = {system.size(), MeasureClosure(system), system.form_factor_error};
    AddPhase("iterate", stopwatch.Seconds());
    Count();
  }

  // Adds to the phase of that name.
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

  const PointIrradiance& Irradiance() {
    const std::lock_guard<std::mutex> lock(irradiance_making);
    if (!irradiance) {
      const Stopwatch stopwatch;
      irradiance = std::make_unique<PointIrradiance>(Solution(), visibility, options.point,
                                                     solver ? solver->SeenFromLeaves() : nullptr);
      AddPhase("iterate", stopwatch.Seconds());
    }
    return *irradiance;
  }

  SourceCells Cells() {
    return SourceCells(Solution(), mesh_forest, triangulations, mesh, Irradiance(),
                       kFinestScore * options.error);
  }

  // Exact irradiance from the finest sources that the interpolants give, with the bounces over the links of
  // what these differ by: between walls that face each other a difference comes back many times.
  PointIrradiance BetterIrradiance() {
    const SourceCells cells = Cells();
    HierarchicalSolver better(scene, visibility, resolved.solver, solver->solution());
    better.CorrectTo(cells.LeafIrradiance(), cells.Fragments(cells.Cut(0), /*whole_leaves=*/true), {});
    return Irradiance().WithSources(SourceSet::FromSolution(better.solution()));
  }

  // Gives the leaves the means of the interpolants, and cuts those whose light varies too much for where it
  // arrives: by the score, which is chosen where there is none. Returns how far the means were from the
  // leaves' (SourceCells::Change); nothing if it was cancelled.
  std::optional<double> RefineSources(std::optional<double>& score, const ExecutionContext& context) {
    const Stopwatch stopwatch;
    context.Report("refine sources", 0);
    const SourceCells cells = Cells();
    const double change = cells.Change();
    if (!score)
      score = ChooseSourceCut(solver->solution(), cells, Irradiance(), kFinestScore * options.error,
                              kSourceShare * options.error, kCutPoints, options.seed + 1)
                  .score;
    const bool done = solver->CorrectTo(cells.LeafIrradiance(),
                                        cells.Fragments(cells.Cut(*score), /*whole_leaves=*/false), context);
    irradiance.reset();
    AddPhase("iterate", stopwatch.Seconds());
    return done ? std::optional(change) : std::nullopt;
  }

  // Refines the sources by what they show and shows them anew, in turns, until the light stands still: what
  // is left to change comes back by the bounces between walls that face each other. False if it was
  // cancelled.
  bool SettleSources(const MeshOptions& first, MeshReport& done, const ExecutionContext& context) {
    std::optional<double> score;
    double before = 0, ratio_before = 0;  // the change of the last pass, and what it left of the one before
    for (int pass = 1;; ++pass) {
      if (pass <= kCutChoices) score.reset();
      const std::optional<double> change = RefineSources(score, context);
      if (!change) return false;
      const double ratio = before > 0 ? *change / before : 1;
      if (pass == 2) ratio_before = ratio;
      // Two factors take turns, since what one wall sends another sends back.
      const double by_two = ratio * ratio_before, next = *change * std::max(ratio, ratio_before);
      const bool still = pass > kCutChoices + 1 && by_two > kStill;
      const bool settled = by_two < 1 && next / (1 - std::sqrt(by_two)) <= kSettledShare * options.error;
      if (settled || still || pass == kMostSourcePasses) return true;
      before = *change;
      ratio_before = ratio;
      if (!Refine(first, kInterpolantShare * options.error, resolved.solver.correction_tolerance, nullptr,
                  done, context))
        return false;
    }
  }

  // What the latest mesh has replaces what was counted; work adds up.
  static void TakeReport(MeshReport latest, MeshReport& done) {
    latest.counts.point_evaluations += done.counts.point_evaluations;
    latest.seconds.discontinuities += done.seconds.discontinuities;
    latest.seconds.triangulate += done.seconds.triangulate;
    latest.seconds.interpolate += done.seconds.interpolate;
    done = latest;
  }

  // Makes a mesh of the solution's leaves. Adds to the report. False if it was cancelled.
  bool FirstLook(const MeshOptions& mesh_options, double tolerance, MeshReport& done,
                 const ExecutionContext& context) {
    IrradianceSampler sampler;
    if (mesh_options.order != InterpolantOrder::kConstant) {
      const Stopwatch stopwatch;
      if (solver && !solver->SeenFromLeaves(context)) return false;
      done.seconds.interpolate += stopwatch.Seconds();
      sampler = NearSampler(tolerance);
    }
    MeshResult result = RunLocalPass(visibility, Solution(), sampler, mesh_options, context, &LocalPass());
    if (context.Cancelled()) return false;
    TakeReport(result.report, done);
    mesh = std::move(result.mesh);
    triangulations = std::move(result.triangulations);
    mesh_forest = Solution().forest;
    triangle_errors.clear();
    return true;
  }

  // Sources, then leaves of the mesh, as fine as the error asked for wants them, from a mesh of `first`. Adds
  // to the report.
  void RefineShown(const MeshOptions& mesh_options, const MeshOptions& first, MeshReport& done,
                   const ExecutionContext& context) {
    if (resolved.solver.source_error == 0 && !SettleSources(first, done, context)) return;
    const double error = kInterpolantShare * options.error, tolerance = kNearShare * options.error;
    SampleCache samples;
    std::optional<RefinedMesh> refined = Refine(mesh_options, error, tolerance, &samples, done, context);
    double onward = error;
    for (int turn = 1; refined && turn <= kMostTurns && refined->share_above <= kShareAbove; ++turn) {
      const std::size_t points =
          std::clamp(refined->report.counts.point_evaluations / kEvaluationsALook, kFewestLooks, kMostLooks);
      if (!Overlooks(points, options.seed + 1 + static_cast<std::uint64_t>(turn), tolerance, done)) return;
      onward *= kOnward;
      refined = Refine(mesh_options, onward, tolerance, &samples, done, context);
    }
    if (!refined || onward < error) return;  // what is left is measured
    double area = 0;
    for (const ElementId leaf : refined->unmet) area += mesh_forest[leaf].area;
    report.unmet.push_back(fmt::format(
        "interpolants: triangles on {:.2g} of the area err by more than {:.3g}; {} leaves of {:.3g} m^2 "
        "together have the smallest area",
        refined->share_above, error, refined->unmet.size(), area));
  }

  // Whether so many random points see more of the interpolants err than those did that refined the mesh.
  bool Overlooks(std::size_t points, std::uint64_t seed, double tolerance, MeshReport& done) {
    const Stopwatch stopwatch;
    const RepresentationError seen =
        MeasureRepresentationError(scene, mesh, NearSampler(tolerance), points, seed);
    done.counts.point_evaluations += points;
    done.seconds.interpolate += stopwatch.Seconds();
    return seen.p99 > kOverlooked * options.error;
  }

  // Refines the leaves of the present mesh until their interpolants err by no more than `error`, and makes it
  // anew. `samples` are those of the same sources and tolerance, or null. Adds to the report. What is
  // returned has given its mesh away; nothing if it was cancelled.
  std::optional<RefinedMesh> Refine(const MeshOptions& mesh_options, double error, double tolerance,
                                    SampleCache* samples, MeshReport& done, const ExecutionContext& context) {
    MeshRefinementOptions refinement;
    refinement.error = error;
    refinement.min_area = resolved.solver.min_area;
    refinement.samples = options.error_samples;
    RefinedMesh refined = RefineMesh(visibility, solver->solution(), NearSampler(tolerance), mesh_options,
                                     refinement, context, &LocalPass(), &mesh_forest, samples);
    if (context.Cancelled()) return std::nullopt;
    mesh = std::move(refined.mesh);
    triangulations = std::move(refined.triangulations);
    mesh_forest = std::move(refined.forest);
    triangle_errors = std::move(refined.errors);
    TakeReport(refined.report, done);
    return refined;
  }

  LocalPassCache& LocalPass() {
    if (!local_pass) local_pass = std::make_unique<LocalPassCache>(scene, visibility);
    return *local_pass;
  }

  IrradianceSampler NearSampler(double tolerance) {
    const PointIrradiance& exact = Irradiance();
    return [&exact, tolerance](PatchId patch, const ReceiverPoint& at) {
      return exact.NearlyOnPatch(patch, at, tolerance);
    };
  }

  // Whether the interpolants' means make the last correction.
  bool RefinesShown() const {
    return options.refine != RefineBy::kTransport && !options.dense && !options.source_error;
  }

  // What is left of the limits to Solve(); none without it.
  RunLimits LimitsSinceSolve(const ExecutionContext& context) const {
    return RunLimits(context, begun ? options.time_limit : std::nullopt,
                     begun ? options.memory_limit : std::nullopt, begun.value_or(RunLimits::Clock::now()));
  }

  // Makes the mesh of that kind, from the solution as it is; for interpolants refines what they show, unless
  // that is cancelled or not asked for. Returns the kind; nothing if it was cancelled before there was a
  // mesh. Adds to the report.
  std::optional<MeshKind> MakeMesh(MeshKind kind, const ExecutionContext& context, bool as_it_is,
                                   MeshReport& done) {
    MeshOptions mesh_options;
    mesh_options.discontinuities = resolved.discontinuities;
    if (kind != MeshKind::kGouraudMesh && kind != MeshKind::kInterpolant)
      mesh_options.discontinuities.choice = DiscontinuityChoice::kNone;
    mesh_options.order = kind == MeshKind::kFlat          ? InterpolantOrder::kConstant
                         : kind == MeshKind::kInterpolant ? InterpolantOrder::kQuadratic
                                                          : InterpolantOrder::kLinear;
    const bool refines =
        kind == MeshKind::kInterpolant && solver && options.refine != RefineBy::kTransport && !as_it_is;
    MeshOptions first = mesh_options;
    if (refines) first.discontinuities.min_weight *= kFirstWeight;
    const double tolerance = refines ? resolved.solver.correction_tolerance : kNearShare * options.error;
    if (!FirstLook(first, tolerance, done, context)) return std::nullopt;
    if (refines && !mesh.triangles.empty()) RefineShown(mesh_options, first, done, context);
    return kind;
  }

  // Runs one step of the solver, which says whether it was done, and counts what it left.
  template <class Step>
  bool Run(const ExecutionContext& context, const Step& step) {
    const Stopwatch stopwatch;
    const bool done = step(*solver, context);
    if (done) Forget();
    AddPhase("iterate", stopwatch.Seconds());
    Count();
    return done;
  }

  // The same for a step that says what it did, which the report keeps.
  template <class Step>
  std::optional<IterationReport> RunIteration(const ExecutionContext& context, const Step& step) {
    std::optional<IterationReport> done;
    Run(context, [&](HierarchicalSolver& of, const ExecutionContext& running) {
      done = step(of, running);
      return done.has_value();
    });
    if (done) report.iterations.push_back(*done);
    return done;
  }

  // What was missed before is told again if it is missed again.
  void DropUnmet(std::string_view stage) {
    std::erase_if(report.unmet, [&](const std::string& line) { return line.starts_with(stage); });
  }

  // What was made of a solution that is no more.
  void Forget() {
    irradiance.reset();
    mesh_kind.reset();
  }

  // The solution that another one made, which a step begins with or drops; what that one told is gone.
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
  impl_->mesh = std::move(state.mesh);
  impl_->locator = std::make_unique<MeshLocator>(scene, impl_->mesh);
  impl_->report = std::move(state.report);
}

Pipeline::~Pipeline() = default;

void Pipeline::Link(const ExecutionContext& context) {
  if (impl_->solver && impl_->solver->Linked()) return;
  context.Report("link", 0);
  const Stopwatch linking;
  if (impl_->stored) impl_->TakeStored();
  impl_->local_pass.reset();
  if (impl_->solver) impl_->Forget();  // of a linking that was cancelled
  impl_->visibility = PatchVisibility(impl_->scene, context);
  if (impl_->options.dense) {
    impl_->AddPhase("link", linking.Seconds());
    impl_->SolveDenseSystem(context);
    if (impl_->solver) return;
  }
  impl_->solver =
      std::make_unique<HierarchicalSolver>(impl_->scene, impl_->visibility, impl_->resolved.solver, context);
  impl_->AddPhase("link", linking.Seconds());
  impl_->Count();
}

std::optional<IterationReport> Pipeline::Iterate(const ExecutionContext& context) {
  Link(context);
  return impl_->RunIteration(context, [](HierarchicalSolver& solver, const ExecutionContext& running) {
    return solver.Iterate(running);
  });
}

bool Pipeline::Converged() const { return impl_->solver && impl_->solver->Converged(); }

bool Pipeline::Correct(const ExecutionContext& context) {
  Link(context);
  const bool done = impl_->Run(context, [this](HierarchicalSolver& solver, const ExecutionContext& running) {
    return solver.CorrectAll(running, /*but_the_last=*/impl_->RefinesShown());
  });
  if (!done) impl_->Forget();  // some passes may have been made
  return done;
}

bool Pipeline::SubdivideLeaves(std::span<const ElementId> leaves, const ExecutionContext& context) {
  Link(context);
  return impl_->Run(context, [&](HierarchicalSolver& solver, const ExecutionContext& running) {
    return solver.SubdivideLeaves(leaves, running);
  });
}

std::optional<IterationReport> Pipeline::Relight(const ExecutionContext& context) {
  if (impl_->stored) {
    const Stopwatch linking;
    impl_->solver = std::make_unique<HierarchicalSolver>(impl_->scene, impl_->visibility,
                                                         impl_->resolved.solver, impl_->TakeStored());
    impl_->AddPhase("link", linking.Seconds());
  }
  Link(context);
  return impl_->RunIteration(context, [](HierarchicalSolver& solver, const ExecutionContext& running) {
    return solver.Relight(running);
  });
}

void Pipeline::SolveOverLinks(const ExecutionContext& context) {
  CountLimits();
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

void Pipeline::Solve(const ExecutionContext& context) {
  CountLimits();
  const RunLimits limits = impl_->LimitsSinceSolve(context);
  const ExecutionContext& running = limits.context();
  Link(running);
  if (!impl_->solver->Linked()) {
    if (const std::optional<std::string> limit = limits.Exceeded())
      impl_->report.unmet.push_back(
          fmt::format("link: ended by {}: nothing is linked, and dark but for what it emits", *limit));
    return;
  }
  if (impl_->options.dense) return;
  const int most = impl_->resolved.solver.max_iterations;
  for (int i = 0; i < most && !Converged() && !running.Cancelled(); ++i) {
    running.Report("iterate", static_cast<double>(i) / most);
    Iterate(running);
  }
  const std::vector<IterationReport>& iterations = impl_->report.iterations;
  const double residual = iterations.empty() ? INFINITY : iterations.back().residual;
  if (!Converged() && !running.Cancelled())
    impl_->report.unmet.push_back(
        fmt::format("iterate: {} iterations left a residual of {:.2g}", iterations.size(), residual));
  const bool corrected = Correct(running);
  if (const std::optional<std::string> limit = limits.Exceeded(); limit && (!Converged() || !corrected))
    impl_->report.unmet.push_back(fmt::format("iterate: ended by {} after {} iterations, {} and {}", *limit,
                                              iterations.size(), Converged() ? "converged" : "not converged",
                                              corrected ? "corrected" : "not corrected to the end"));
}

void Pipeline::CountLimits() { impl_->begun = RunLimits::Clock::now(); }

void Pipeline::BuildMesh(MeshKind kind, const ExecutionContext& context, bool as_it_is) {
  if (impl_->mesh_kind == kind && (as_it_is || !impl_->mesh_unrefined)) return;
  const RunLimits limits = impl_->LimitsSinceSolve(context);
  if (!impl_->stored)
    for (const char* stage : {"mesh: ", "discontinuities: ", "interpolants: "}) impl_->DropUnmet(stage);
  MeshReport report;
  // What needs no irradiance at points is quick, and made whatever the limits say.
  const bool flat = kind == MeshKind::kFlat;
  std::optional<MeshKind> made = impl_->MakeMesh(kind, flat ? context : limits.context(), as_it_is, report);
  if (!made && !flat && !context.Cancelled()) {
    report = {};
    made = impl_->MakeMesh(MeshKind::kFlat, context, as_it_is, report);
  }
  if (const std::optional<std::string> limit = limits.Exceeded(); limit && !flat)
    impl_->report.unmet.push_back(
        fmt::format("mesh: ended by {}, {}", *limit,
                    made == kind ? "and not refined by what is shown"
                                 : "before there were interpolants: leaves show their mean"));
  impl_->mesh_kind = context.Cancelled() ? std::nullopt : made;
  impl_->mesh_unrefined = as_it_is;
  impl_->locator = std::make_unique<MeshLocator>(impl_->scene, impl_->mesh);

  impl_->AddPhase("discontinuities", report.seconds.discontinuities);
  impl_->AddPhase("triangulate", report.seconds.triangulate);
  impl_->AddPhase("interpolate", report.seconds.interpolate);
  PipelineReport::Counts& counts = impl_->report.counts;
  counts.discontinuities = report.counts.discontinuities;
  counts.dsets_active = report.counts.dsets_active;
  counts.most_merged = report.counts.most_merged;
  counts.triangles = report.counts.triangles;
  counts.interpolants = report.counts.interpolants;
  counts.point_evaluations = report.counts.point_evaluations;
  if (report.counts.refused_contacts > 0)
    impl_->report.unmet.push_back(
        fmt::format("discontinuities: {} contact edges left out, since a leaf would have more "
                    "than {} discontinuity edges",
                    report.counts.refused_contacts, impl_->resolved.discontinuities.max_leaf_dsets));
}

void Pipeline::Diagnose() {
  PENUMBRA_CHECK(impl_->locator != nullptr);
  PipelineReport& report = impl_->report;
  report.energy = MeasureEnergy(solution());
  report.links = DiagnoseLinks(solution());
  report.views = DiagnoseViews(impl_->scene);
  report.quality = MeasureQuality(impl_->mesh);
  if (impl_->solver) report.bounces = impl_->solver->MeanIrradianceByBounce(impl_->options.bounces);
  report.warnings.clear();
  if (!report.views.reversed_faces.empty())
    report.warnings.push_back(fmt::format(
        "{}: warning: the fronts of {} faces see nothing but backs, the first is face {} (counted "
        "from 0); if it is reversed, give its vertices in the other order",
        impl_->scene.name, report.views.reversed_faces.size(), report.views.reversed_faces[0]));
}

void Pipeline::Measure(const ExecutionContext& context) {
  PENUMBRA_CHECK(impl_->triangulations.size() == impl_->scene.patches.size());
  context.Report("measure", 0);
  Diagnose();
  impl_->DropUnmet("error: ");
  PipelineReport& report = impl_->report;
  report.interpolant_error = report.whole_error = {};
  report.solution_error_estimate = 0;
  const RunLimits limits = impl_->LimitsSinceSolve(context);
  if (impl_->solver && !impl_->solver->SeenFromLeaves(limits.context())) {
    report.error_met = false;
    report.unmet.push_back("error: not measured, since there was no time to find what the leaves see");
    return;
  }
  const std::size_t points = impl_->options.error_points;
  if (points == 0) {
    report.error_met = false;
    report.unmet.push_back("error: not measured, since no points were asked for");
    return;
  }
  const std::uint64_t seed = impl_->options.seed;
  const PointIrradiance better = impl_->BetterIrradiance();
  const double tolerance = kMeasuredShare * report.error_asked;
  const IrradianceSampler sampler = impl_->NearSampler(tolerance);
  const auto better_sampler = [&](PatchId patch, const ReceiverPoint& at) {
    return better.NearlyOnPatch(patch, at, tolerance);
  };
  const auto measure = [&](std::size_t at) {
    return MeasureError(impl_->scene, impl_->mesh, sampler, better_sampler, at, seed, report.error_asked);
  };
  MeasuredError error = measure(std::min(points, kFewSourcePoints));
  if (points > kFewSourcePoints && error.above > kClearlyMet && error.above < kClearlyMissed)
    error = measure(points);
  report.interpolant_error =
      error.interpolant.points == points
          ? error.interpolant
          : MeasureRepresentationError(impl_->scene, impl_->mesh, sampler, points, seed);
  report.solution_error_estimate = error.sources.p99;
  report.whole_error = error.whole;
  report.error_met = std::max(report.interpolant_error.p99, error.whole.p99) <= report.error_asked;
  if (!report.error_met)
    report.unmet.push_back(fmt::format(
        "error: {:.3g} of the interpolants and {:.3g} of their sources (99th percentiles) make {:.3g}; the "
        "worst point is ({:.4g}, {:.4g}, {:.4g})",
        report.interpolant_error.p99, error.sources.p99, error.whole.p99, error.whole.worst_point.x(),
        error.whole.worst_point.y(), error.whole.worst_point.z()));
}

void Pipeline::SetErrorPoints(std::size_t points) { impl_->options.error_points = points; }

const Scene& Pipeline::scene() const { return impl_->scene; }
const PipelineOptions& Pipeline::options() const { return impl_->options; }
const ResolvedOptions& Pipeline::resolved() const { return impl_->resolved; }
const RadiositySolution& Pipeline::solution() const { return impl_->Solution(); }
const PatchVisibility& Pipeline::visibility() const { return impl_->visibility; }
const PointIrradiance& Pipeline::irradiance() const { return impl_->Irradiance(); }
const IrradianceMesh& Pipeline::mesh() const { return impl_->mesh; }
std::optional<MeshKind> Pipeline::mesh_kind() const { return impl_->mesh_kind; }
std::span<const TriangleError> Pipeline::triangle_errors() const { return impl_->triangle_errors; }
const PipelineReport& Pipeline::report() const { return impl_->report; }

std::optional<Rgb> Pipeline::Interpolated(PatchId patch, const Vec3& point, double reach) const {
  PENUMBRA_CHECK(impl_->locator != nullptr);
  const auto location = impl_->locator->Find(patch, point, reach);
  if (!location) return std::nullopt;
  return Rgb(IrradianceAt(impl_->mesh, *location).max(0.0));
}

}  // namespace penumbra
