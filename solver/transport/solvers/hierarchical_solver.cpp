#include "solver/transport/solvers/hierarchical_solver.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/base/processes.h"
#include "solver/base/stopwatch.h"
#include "solver/geometry/vec_bytes.h"
#include "solver/transport/points/leaf_cells.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/sources/error_floors.h"
#include "solver/transport/sources/leaf_fragments.h"

namespace penumbra {
namespace {

// The residual of light that no sweep has measured.
constexpr double kNotSettled = 1;

constexpr std::size_t kExactGrain = 8;  // leaves in one task of correction
// Error of the first pass that prepares the parts of leaves, and the factor between passes: about the gain of
// a pass.
constexpr double kCoarsestCells = 0.1, kCellStep = 4;
// At or below this error, a pass that cuts nothing further is the last.
constexpr double kFineCells = 1e-3;

}  // namespace

HierarchicalSolver::HierarchicalSolver(const Scene& scene, const PatchVisibility& visibility,
                                       const SolverOptions& options, const ExecutionContext& context)
    : scene_(scene), visibility_(visibility), options_(options), links_(scene, visibility, options, context) {
  report_.most_iterations = options.max_iterations;
}

HierarchicalSolver::HierarchicalSolver(const Scene& scene, const PatchVisibility& visibility,
                                       const SolverOptions& options, RadiositySolution solution,
                                       const ExecutionContext& context)
    : scene_(scene),
      visibility_(visibility),
      options_(options),
      links_(scene, visibility, options, std::move(solution), context) {
  report_.most_iterations = options.max_iterations;
  FindCorrections();
}

HierarchicalSolver::HierarchicalSolver(const HierarchicalSolver& other, const PatchVisibility& visibility)
    : scene_(other.scene_),
      visibility_(visibility),
      options_(other.options_),
      links_(other.links_, visibility),
      correction_(other.correction_),
      corrected_(other.corrected_),
      report_(other.report_),
      relit_at_(other.relit_at_),
      seen_from_leaves_(other.seen_from_leaves_) {}

std::unique_ptr<LightSolver> HierarchicalSolver::Copy(const PatchVisibility& visibility) const {
  return std::unique_ptr<LightSolver>(new HierarchicalSolver(*this, visibility));
}

// Finds the corrections that lead from the light of the links to the present light.
void HierarchicalSolver::FindCorrections() {
  const RadiositySolution& light = links_.solution();
  const PushPull& push_pull = links_.push_pull();
  // The correction of a leaf is its irradiance minus that of its links.
  const std::vector<Rgb> linked = push_pull.Transport(light.radiosity);
  correction_.of_element.assign(light.forest.size(), Rgb::Zero());
  for (const ElementId leaf : push_pull.leaves())
    correction_.of_element[leaf] = light.irradiance[leaf] - linked[leaf];
  correction_.of_fragment.clear();
  for (const Fragment& fragment : light.fragments)
    correction_.of_fragment.push_back(fragment.irradiance - light.irradiance[fragment.leaf]);
}

HierarchicalSolver::Snapshot HierarchicalSolver::TakeSnapshot() const {
  return {links_.TakeSnapshot(), correction_, corrected_};
}

void HierarchicalSolver::Restore(Snapshot before) {
  if (links_.Restore(std::move(before.links))) seen_from_leaves_.Reset();
  correction_ = std::move(before.correction);
  corrected_ = before.corrected;
}

// Corrections of old leaves are not valid for new leaves or for other light.
void HierarchicalSolver::TakeCorrectionsBack() {
  links_.solution().fragments.clear();
  correction_ = {};
  corrected_ = false;
}

double HierarchicalSolver::PartOfTolerance() const {
  return links_.to_come() > kNearlyWhite ? kNearlyWhite / links_.to_come() : 1;
}

PointIrradianceOptions HierarchicalSolver::HowToSample() const {
  PointIrradianceOptions options;
  options.part_of_tolerance = PartOfTolerance();
  options.method = options_.occlusion.get();
  return options;
}

std::optional<SolverStep> HierarchicalSolver::Next() const {
  if (!Ready()) return std::nullopt;
  const std::span<const IterationReport> since = std::span(report_.iterations).subspan(relit_at_);
  const bool may_iterate = static_cast<int>(since.size()) < options_.max_iterations && !IsStuck(since);
  if (!Converged() && may_iterate) return SolverStep::kIterate;
  return corrected_ ? std::nullopt : std::optional(SolverStep::kCorrect);
}

std::optional<SolverStep> HierarchicalSolver::NextSmall() const {
  const std::optional<SolverStep> next = Next();
  if (next != SolverStep::kIterate) return next;
  const bool settled = report_.begun && report_.begun->residual <= links_.Cutoff();
  return settled ? SolverStep::kSplit : SolverStep::kSweep;
}

bool HierarchicalSolver::Step(SolverStep step, const ExecutionContext& context) {
  switch (step) {
    case SolverStep::kIterate:
      return Iterate(context).has_value();
    case SolverStep::kCorrect:
      return CorrectAll(context);
    case SolverStep::kSweep:
      return Sweep(context);
    case SolverStep::kSplit:
      return SplitOnce(context);
  }
  return false;
}

// The iteration that small steps are in.
IterationReport& HierarchicalSolver::Begun() {
  if (report_.begun) return *report_.begun;
  report_.begun.emplace();
  report_.begun->residual = kNotSettled;
  report_.begun->eps = links_.eps();
  return *report_.begun;
}

// Ends it, if it is as complete as one that Iterate() makes.
void HierarchicalSolver::EndBegun() {
  links_.EndIteration(*report_.begun);
  report_.iterations.push_back(*report_.begun);
  report_.begun.reset();
}

bool HierarchicalSolver::Sweep(const ExecutionContext& context) {
  const Stopwatch stopwatch;
  Snapshot before = TakeSnapshot();
  IterationReport& report = Begun();
  if (!links_.Sweep(correction_.of_element, report, context)) {
    Restore(std::move(before));
    return false;
  }
  corrected_ = false;
  report.elements = solution().forest.size();
  report.links = solution().links.links.size();
  report.seconds += stopwatch.Seconds();
  return true;
}

bool HierarchicalSolver::SplitOnce(const ExecutionContext& context) {
  const Stopwatch stopwatch;
  Snapshot before = TakeSnapshot();
  IterationReport& report = Begun();
  const std::size_t split_before = report.links_split;
  if (!links_.Split(before.links, report, context, 1)) {
    report.links_split = split_before;
    seen_from_leaves_.Reset();
    Restore(std::move(before));
    return false;
  }
  report_.full = links_.Full();
  report.seconds += stopwatch.Seconds();
  if (report.links_split == split_before) {  // nothing is left to split by this light
    EndBegun();
    return true;
  }
  seen_from_leaves_.Reset();
  TakeCorrectionsBack();
  report.residual = kNotSettled;
  report.elements = solution().forest.size();
  report.links = solution().links.links.size();
  return true;
}

std::optional<IterationReport> HierarchicalSolver::Iterate(const ExecutionContext& context) {
  const Stopwatch stopwatch;
  Snapshot before = TakeSnapshot();
  report_.begun.reset();
  IterationReport report;
  report.eps = links_.eps();
  const double cutoff = links_.Cutoff();
  bool going = links_.Settle(correction_.of_element, cutoff, report, context) &&
               links_.Split(before.links, report, context);
  if (report.links_split > 0) {
    seen_from_leaves_.Reset();
    if (going) TakeCorrectionsBack();
    // The new links carry light at once, so that the solution is consistent with all links.
    going = going && links_.Settle(correction_.of_element, cutoff, report, context);
  }
  report_.full = links_.Full();
  if (!going) {
    Restore(std::move(before));
    return std::nullopt;
  }
  corrected_ = false;
  links_.EndIteration(report);
  report.seconds = stopwatch.Seconds();
  report_.iterations.push_back(report);
  return report;
}

bool HierarchicalSolver::Relight(const ExecutionContext& context) {
  const Stopwatch stopwatch;
  Snapshot before = TakeSnapshot();
  report_.begun.reset();
  TakeCorrectionsBack();
  links_.ReflectAnew();
  IterationReport report;
  if (!links_.Settle(correction_.of_element, report, context)) {
    Restore(std::move(before));
    return false;
  }
  report.eps = options_.eps;
  report.elements = solution().forest.size();
  report.links = solution().links.links.size();
  report.seconds = stopwatch.Seconds();
  report_.iterations.push_back(report);
  relit_at_ = report_.iterations.size();
  return true;
}

std::optional<double> HierarchicalSolver::CorrectByCells(double error, const ExecutionContext& context) {
  const RadiositySolution& solution = links_.solution();
  const ElementForest& forest = solution.forest;
  std::vector<ElementId> leaves = forest.AllLeaves();
  std::sort(leaves.begin(), leaves.end());
  const LeafCellOptions options = {error, kPartFloor * MeanReflected(solution), options_.min_area};
  std::vector<std::vector<Polygon3>> parts = correction_.parts_of_leaf;
  if (parts.empty()) {
    const std::vector<Fragment> cuts = CutLeavesAtContacts(forest, context);
    parts.resize(leaves.size());
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      for (const Fragment& cut : FragmentsOf(cuts, leaves[i])) parts[i].push_back(cut.polygon);
      const auto whole = forest[leaves[i]].Vertices();
      if (parts[i].empty()) parts[i].emplace_back(whole.begin(), whole.end());
    }
  }
  const std::shared_ptr<const LeafVisibility> seen = SeenFromLeaves(context);
  if (!seen) return std::nullopt;
  const PointIrradiance exact(solution, visibility_, HowToSample(), seen);
  std::vector<std::vector<Fragment>> pieces(leaves.size());
  std::vector<Rgb> irradiance(forest.size(), Rgb::Zero());
  ParallelFor(leaves.size(), 1, [&](std::size_t i) {
    if (context.Cancelled()) return;
    const ElementId leaf = leaves[i];
    Rgb& mean = irradiance[static_cast<std::size_t>(leaf)];
    if ((scene_.MaterialOf(forest[leaf].patch).reflectance == 0).all()) {
      mean = ExactLeafIrradiance(solution, exact, leaf, LeafSampling::kCubature).mean;
      return;
    }
    LeafCells cells = CutLeaf(solution, exact, leaf, std::move(parts[i]), options);
    mean = cells.Mean();
    parts[i] = std::move(cells.parts);
    if (cells.pieces.size() > 1) pieces[i] = std::move(cells.pieces);
  });
  if (context.Cancelled()) return std::nullopt;

  double squares = 0, total = 0, area = 0;
  std::vector<Fragment> fragments;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const ElementId leaf = leaves[i];
    const double a = forest[leaf].area;
    const Rgb& now = irradiance[static_cast<std::size_t>(leaf)];
    const double change = (now - solution.irradiance[leaf]).abs().maxCoeff();
    squares += a * change * change;
    total += a * now.maxCoeff();
    area += a;
    std::move(pieces[i].begin(), pieces[i].end(), std::back_inserter(fragments));
  }
  if (!SetLight(irradiance, std::move(fragments), context)) return std::nullopt;
  correction_.parts_of_leaf = std::move(parts);
  return total > 0 ? std::sqrt(squares / area) / (total / area) : 0;
}

std::optional<double> HierarchicalSolver::Correct(LeafSampling sampling, const ExecutionContext& context) {
  if (options_.source_error > 0) return CorrectByCells(options_.source_error, context);
  Snapshot before = TakeSnapshot();
  RadiositySolution& solution = links_.solution();
  if (correction_.of_fragment.empty()) {
    solution.fragments = CutLeavesAtContacts(solution.forest, context);
    correction_.of_fragment.assign(solution.fragments.size(), Rgb::Zero());
    correction_.LightFragments(solution);
  }
  const std::optional<double> change = AddExact(sampling, context);
  IterationReport ignored;
  if (!change || !links_.Settle(correction_.of_element, ignored, context)) {
    Restore(std::move(before));
    return std::nullopt;
  }
  correction_.LightFragments(solution);
  return change;
}

// Adds the difference between exact irradiance and the irradiance of leaves and fragments, without bounces.
// Returns the root mean square change of the leaves' irradiance, relative to its mean; nothing if cancelled.
std::optional<double> HierarchicalSolver::AddExact(LeafSampling sampling, const ExecutionContext& context) {
  const RadiositySolution& solution = links_.solution();
  const std::span<const ElementId> leaves = links_.push_pull().leaves();
  const std::shared_ptr<const LeafVisibility> seen = SeenFromLeaves(context);
  if (!seen) return std::nullopt;
  const PointIrradiance irradiance(solution, visibility_, HowToSample(), seen);
  std::vector<LeafIrradiance> exact(leaves.size());
  const auto compute = [&](std::size_t i) {
    if (!context.Cancelled())
      exact[i] =
          ExactLeafIrradiance(solution, irradiance, leaves[i], sampling, options_.correction_tolerance);
  };
  const auto transfer = [&](std::size_t i, auto& archive) {
    Transfer(archive, exact[i].mean);
    exact[i].fragments.resize(archive.Count(exact[i].fragments.size()));
    for (Rgb& fragment : exact[i].fragments) Transfer(archive, fragment);
  };
  DealOut({leaves.size(), kExactGrain, compute, transfer, transfer});
  if (context.Cancelled()) return std::nullopt;

  correction_.of_element.resize(solution.forest.size(), Rgb::Zero());
  double squares = 0, mean = 0, area = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const ElementId leaf = leaves[i];
    const double a = solution.forest[leaf].area;
    const Rgb change = exact[i].mean - solution.irradiance[leaf];
    correction_.of_element[leaf] += change;
    squares += a * change.abs().maxCoeff() * change.abs().maxCoeff();
    mean += a * exact[i].mean.maxCoeff();
    area += a;
    if (exact[i].fragments.empty()) continue;
    const auto first =
        static_cast<std::size_t>(solution.FragmentsOf(leaf).data() - solution.fragments.data());
    for (std::size_t f = 0; f < exact[i].fragments.size(); ++f)
      correction_.of_fragment[first + f] = exact[i].fragments[f] - exact[i].mean;
  }
  return mean > 0 ? std::sqrt(squares / area) / (mean / area) : 0;
}

bool HierarchicalSolver::SetLight(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                                  const ExecutionContext& context) {
  Snapshot before = TakeSnapshot();
  RadiositySolution& solution = links_.solution();
  correction_.AddDifference(solution, irradiance);
  solution.fragments = std::move(fragments);
  correction_.of_fragment.clear();
  for (const Fragment& fragment : solution.fragments)
    correction_.of_fragment.push_back(fragment.irradiance -
                                      irradiance[static_cast<std::size_t>(fragment.leaf)]);
  IterationReport ignored;
  if (!links_.Settle(correction_.of_element, ignored, context)) {
    Restore(std::move(before));
    return false;
  }
  correction_.LightFragments(solution);
  return true;
}

std::unique_ptr<LightSolver> HierarchicalSolver::LitAs(const Scene& other,
                                                       const ExecutionContext& context) const {
  PENUMBRA_CHECK(options_.source_error == 0);
  RadiositySolution same = solution();
  same.forest = same.forest.Of(other);
  auto lit =
      std::make_unique<HierarchicalSolver>(other, visibility_, options_, std::move(same), ExecutionContext());
  lit->seen_from_leaves_ = seen_from_leaves_;
  if (!lit->Relight(context)) return nullptr;
  if (!options_.last_correction_elsewhere && !lit->CorrectAll(context)) return nullptr;
  return lit;
}

void HierarchicalSolver::ReplaceLight(std::span<const Rgb> element, std::span<const Rgb> fragment) {
  ReplaceIrradiance(element, fragment, links_.solution());
  FindCorrections();
}

std::shared_ptr<const LeafVisibility> HierarchicalSolver::SeenFromLeaves(const ExecutionContext& context) {
  return seen_from_leaves_.Get(solution().forest, visibility_, context);
}

std::vector<Rgb> HierarchicalSolver::MeanIrradianceByBounce(int bounces) const {
  const ElementForest& forest = links_.solution().forest;
  std::vector<Rgb> radiosity(forest.size()), means;
  for (std::size_t e = 0; e < forest.size(); ++e)
    radiosity[e] = scene_.MaterialOf(forest.elements()[e].patch).emittance;
  for (int bounce = 0; bounce < bounces; ++bounce) {
    radiosity = links_.push_pull().Transport(radiosity);
    Rgb sum = Rgb::Zero();
    double area = 0;
    for (std::size_t p = 0; p < scene_.patches.size(); ++p) {
      sum += scene_.patches[p].area * radiosity[p];
      area += scene_.patches[p].area;
    }
    means.push_back(area > 0 ? Rgb(sum / area) : Rgb::Zero());
    for (std::size_t e = 0; e < forest.size(); ++e)
      radiosity[e] *= scene_.MaterialOf(forest.elements()[e].patch).reflectance;
  }
  return means;
}

bool HierarchicalSolver::CorrectAll(const ExecutionContext& context) {
  const bool cells = options_.source_error > 0 && options_.max_corrections > 0;
  const auto parts = [&] {
    std::size_t count = 0;
    for (const std::vector<Polygon3>& leaf : correction_.parts_of_leaf) count += leaf.size();
    return count;
  };
  for (double error = kCoarsestCells; cells && error > options_.source_error && !context.Cancelled();
       error /= kCellStep) {
    const std::size_t before = parts();
    if (!CorrectByCells(error, context)) break;
    // If all parts are as small as allowed, a smaller error makes no more cuts.
    if (error < kFineCells && parts() == before) break;
  }
  // All passes except the last may be approximate: the last pass, here or in SetLight(), replaces their
  // corrections.
  const int passes = options_.max_corrections - (options_.last_correction_elsewhere ? 1 : 0);
  for (int pass = 1; pass <= passes && !context.Cancelled(); ++pass) {
    context.Report("correct", static_cast<double>(pass - 1) / options_.max_corrections);
    Correct(pass < options_.max_corrections ? LeafSampling::kCentroid : LeafSampling::kCubature, context);
  }
  corrected_ = !context.Cancelled();
  return corrected_;
}

std::vector<IterationReport> HierarchicalSolver::Solve(const ExecutionContext& context) {
  const std::size_t before = report_.iterations.size();
  SolveStepByStep(*this, context);
  return {report_.iterations.begin() + static_cast<std::ptrdiff_t>(before), report_.iterations.end()};
}

LightSolverRegistry::Method HierarchicalSolverMethod() {
  return {"hierarchical",
          "quadtrees of elements with links between them (Hanrahan, Salzman and Aupperle 1991; thesis, "
          "chapter 4)",
          {"eps", "refine", "relative-cutoff", "corrections", "source-error", "acceleration", "scheme",
           "oracle", "multigrid", "iterations", "bounces", "form-factors"},
          [](const SolverScene& in, const LightSolverOptions& options, const ExecutionContext& context) {
            const PatchVisibility& pairs = in.pairs(context);
            return in.goes_on_from
                       ? std::make_unique<HierarchicalSolver>(in.scene, pairs, options.hierarchical,
                                                              std::move(*in.goes_on_from), context)
                       : std::make_unique<HierarchicalSolver>(in.scene, pairs, options.hierarchical, context);
          }};
}

}  // namespace penumbra
