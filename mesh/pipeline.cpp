#include "mesh/pipeline.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "mesh/local_pass.h"
#include "mesh/mesh_locator.h"
#include "mesh/source_error.h"
#include "solver/base/check.h"
#include "solver/base/stopwatch.h"
#include "solver/transport/solution_error.h"

namespace penumbra {
namespace {

// What follows from the error asked for. Measured on closed boxes and furnished rooms: with these the 99th
// percentile stays at or below the error asked for where the interpolants are not limited by weak
// discontinuities.
constexpr double kEpsOfMeanIrradiance = 2;  // eps = this x error x mean irradiance
constexpr double kWeightOfStrongest = 5;    // minimum weight = this x error x largest emittance, at most ...
constexpr double kLargestWeight = 0.25;     // ... this x largest emittance
// In the irradiance weight: what an edge left out may cost, as a part of error x mean irradiance.
constexpr double kWeightOfMeanIrradiance = 0.5;
constexpr int kCrowdedSplits = 3;         // DiscontinuityOptions::crowded_splits
constexpr double kMinAreaOfScene = 1e-7;  // of the fronts' total area
constexpr double kCutoffOfError = 0.005;

struct SceneTotals {
  double area = 0, flux = 0, reflectance = 0, strongest = 0;  // of the brightest channel
};

SceneTotals Total(const Scene& scene) {
  SceneTotals totals;
  Rgb flux = Rgb::Zero(), reflectance = Rgb::Zero();
  for (const Patch& patch : scene.patches) {
    const Material& material = scene.materials[patch.material];
    totals.area += patch.area;
    flux += patch.area * material.emittance;
    reflectance += patch.area * material.reflectance;
    totals.strongest = std::max(totals.strongest, material.emittance.maxCoeff());
  }
  int channel = 0;
  totals.flux = flux.maxCoeff(&channel);
  if (totals.area > 0) totals.reflectance = reflectance[channel] / totals.area;
  return totals;
}

}  // namespace

ResolvedOptions Resolve(const Scene& scene, const PipelineOptions& options) {
  const SceneTotals totals = Total(scene);
  // What the walls would receive if all light stayed in and spread evenly.
  const double mean = totals.area > 0 ? totals.flux / totals.area / (1 - totals.reflectance) : 0;
  ResolvedOptions resolved;
  resolved.solver.eps = options.eps.value_or(kEpsOfMeanIrradiance * options.error * mean);
  resolved.solver.min_area = options.min_area.value_or(kMinAreaOfScene * totals.area);
  resolved.solver.relative_cutoff = options.relative_cutoff.value_or(kCutoffOfError * options.error);
  resolved.solver.max_iterations = options.max_iterations;
  resolved.solver.max_corrections = options.max_corrections;
  resolved.solver.accelerate = options.accelerate;
  DiscontinuityOptions& mesh = resolved.discontinuities;
  mesh.choice = options.discontinuities;
  mesh.weight = options.weight.value_or(options.min_discontinuity_weight ? DiscontinuityWeight::kThesis
                                                                         : DiscontinuityWeight::kIrradiance);
  const double from_error =
      mesh.weight == DiscontinuityWeight::kThesis
          ? std::min(kLargestWeight, kWeightOfStrongest * options.error) * totals.strongest
          : kWeightOfMeanIrradiance * options.error * mean;
  mesh.min_weight = options.min_discontinuity_weight.value_or(from_error);
  mesh.max_leaf_dsets = options.max_leaf_dsets;
  mesh.keep_hidden = options.keep_hidden_discontinuities;
  mesh.seed = options.seed;
  mesh.crowded_splits = kCrowdedSplits;
  mesh.min_split_area = resolved.solver.min_area;
  return resolved;
}

struct Pipeline::Impl {
  Impl(const Scene& the_scene, const PipelineOptions& the_options)
      : scene(the_scene), options(the_options), resolved(Resolve(the_scene, the_options)) {}

  const Scene& scene;
  PipelineOptions options;
  ResolvedOptions resolved;
  PatchVisibility visibility;
  std::unique_ptr<HierarchicalSolver> solver;  // null until the roots are linked
  std::optional<RadiositySolution> stored;     // that another one made, until a step begins anew
  std::optional<MeshKind> mesh_kind;           // of a mesh of the present solution
  IrradianceMesh mesh;
  std::unique_ptr<MeshLocator> locator;
  PipelineReport report;
  std::mutex irradiance_making;
  std::unique_ptr<PointIrradiance> irradiance;  // of the present solution; null until someone asks

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
      irradiance = std::make_unique<PointIrradiance>(Solution(), visibility, options.point);
      AddPhase("iterate", stopwatch.Seconds());
    }
    return *irradiance;
  }

  IrradianceSampler Sampler() {
    const PointIrradiance& exact = Irradiance();
    return [&exact](PatchId patch, const ReceiverPoint& at) { return exact.OnPatch(patch, at); };
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

  // What was made of a solution that is no more.
  void Forget() {
    irradiance.reset();
    mesh_kind.reset();
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
  if (impl_->solver) return;
  context.Report("link", 0);
  const Stopwatch linking;
  if (impl_->stored) {
    impl_->stored.reset();
    impl_->Forget();
    impl_->report = {};
    impl_->report.error_asked = impl_->options.error;
  }
  impl_->visibility = PatchVisibility(impl_->scene);
  impl_->solver =
      std::make_unique<HierarchicalSolver>(impl_->scene, impl_->visibility, impl_->resolved.solver);
  impl_->AddPhase("link", linking.Seconds());
  impl_->Count();
}

std::optional<IterationReport> Pipeline::Iterate(const ExecutionContext& context) {
  Link(context);
  std::optional<IterationReport> report;
  impl_->Run(context, [&](HierarchicalSolver& solver, const ExecutionContext& running) {
    report = solver.Iterate(running);
    return report.has_value();
  });
  if (report) impl_->report.iterations.push_back(*report);
  return report;
}

bool Pipeline::Converged() const { return impl_->solver && impl_->solver->Converged(); }

bool Pipeline::Correct(const ExecutionContext& context) {
  Link(context);
  return impl_->Run(context, [](HierarchicalSolver& solver, const ExecutionContext& running) {
    return solver.CorrectAll(running);
  });
}

bool Pipeline::SubdivideLeaves(std::span<const ElementId> leaves, const ExecutionContext& context) {
  Link(context);
  return impl_->Run(context, [&](HierarchicalSolver& solver, const ExecutionContext& running) {
    return solver.SubdivideLeaves(leaves, running);
  });
}

bool Pipeline::Relight(const ExecutionContext& context) {
  Link(context);
  return impl_->Run(context, [](HierarchicalSolver& solver, const ExecutionContext& running) {
    return solver.Relight(running);
  });
}

void Pipeline::Solve(const ExecutionContext& context) {
  Link(context);
  const int most = impl_->resolved.solver.max_iterations;
  for (int i = 0; i < most && !Converged() && !context.Cancelled(); ++i) {
    context.Report("iterate", static_cast<double>(i) / most);
    Iterate(context);
  }
  if (context.Cancelled()) return;
  const std::vector<IterationReport>& iterations = impl_->report.iterations;
  if (!Converged())
    impl_->report.unmet.push_back(fmt::format("iterate: {} iterations left a residual of {:.2g}",
                                              iterations.size(),
                                              iterations.empty() ? INFINITY : iterations.back().residual));
  Correct(context);
}

void Pipeline::BuildMesh(MeshKind kind, const ExecutionContext& context) {
  if (impl_->mesh_kind == kind) return;
  MeshOptions options;
  options.discontinuities = impl_->resolved.discontinuities;
  if (kind != MeshKind::kGouraudMesh && kind != MeshKind::kInterpolant)
    options.discontinuities.choice = DiscontinuityChoice::kNone;
  options.order = kind == MeshKind::kFlat          ? InterpolantOrder::kConstant
                  : kind == MeshKind::kInterpolant ? InterpolantOrder::kQuadratic
                                                   : InterpolantOrder::kLinear;
  MeshResult result = RunLocalPass(impl_->visibility, solution(), impl_->Sampler(), options, context);
  impl_->mesh = std::move(result.mesh);
  impl_->mesh_kind = context.Cancelled() ? std::nullopt : std::optional(kind);
  impl_->locator = std::make_unique<MeshLocator>(impl_->scene, impl_->mesh);

  impl_->AddPhase("discontinuities", result.report.seconds.discontinuities);
  impl_->AddPhase("triangulate", result.report.seconds.triangulate);
  impl_->AddPhase("interpolate", result.report.seconds.interpolate);
  PipelineReport::Counts& counts = impl_->report.counts;
  counts.discontinuities = result.report.counts.discontinuities;
  counts.dsets_active = result.report.counts.dsets_active;
  counts.most_merged = result.report.counts.most_merged;
  counts.triangles = result.report.counts.triangles;
  counts.interpolants = result.report.counts.interpolants;
  counts.point_evaluations = result.report.counts.point_evaluations;
  if (result.report.counts.refused_contacts > 0)
    impl_->report.unmet.push_back(
        fmt::format("discontinuities: {} contact edges left out, since a leaf would have more "
                    "than {} discontinuity edges",
                    result.report.counts.refused_contacts, impl_->resolved.discontinuities.max_leaf_dsets));
}

void Pipeline::Measure(const ExecutionContext& context) {
  PENUMBRA_CHECK(impl_->locator != nullptr);
  context.Report("measure", 0);
  PipelineReport& report = impl_->report;
  report.energy = MeasureEnergy(solution());
  const std::size_t points = impl_->options.error_points;
  const std::uint64_t seed = impl_->options.seed;
  const RepresentationError error =
      MeasureRepresentationError(impl_->scene, impl_->mesh, impl_->Sampler(), points, seed);
  report.interpolant_error = error;
  report.solution_error_estimate =
      EstimateSolutionError(solution(), irradiance(), points, seed) +
      EstimateSourceError(solution(), impl_->mesh, impl_->Sampler(), points, seed);
  report.error_met = error.p99 + report.solution_error_estimate <= report.error_asked;
  if (!report.error_met)
    report.unmet.push_back(
        fmt::format("error: {:.3g} of the interpolants (99th percentile) and {:.3g} of the solution "
                    "(estimated) add up to more than "
                    "{:.3g}; the worst "
                    "point is ({:.4g}, {:.4g}, {:.4g})",
                    error.p99, report.solution_error_estimate, report.error_asked, error.worst_point.x(),
                    error.worst_point.y(), error.worst_point.z()));
}

const Scene& Pipeline::scene() const { return impl_->scene; }
const PipelineOptions& Pipeline::options() const { return impl_->options; }
const ResolvedOptions& Pipeline::resolved() const { return impl_->resolved; }
const RadiositySolution& Pipeline::solution() const { return impl_->Solution(); }
const PatchVisibility& Pipeline::visibility() const { return impl_->visibility; }
const PointIrradiance& Pipeline::irradiance() const { return impl_->Irradiance(); }
const IrradianceMesh& Pipeline::mesh() const { return impl_->mesh; }
std::optional<MeshKind> Pipeline::mesh_kind() const { return impl_->mesh_kind; }
const PipelineReport& Pipeline::report() const { return impl_->report; }

std::optional<Rgb> Pipeline::Interpolated(PatchId patch, const Vec3& point, double reach) const {
  PENUMBRA_CHECK(impl_->locator != nullptr);
  const auto location = impl_->locator->Find(patch, point, reach);
  if (!location) return std::nullopt;
  return Rgb(IrradianceAt(impl_->mesh, *location).max(0.0));
}

}  // namespace penumbra
