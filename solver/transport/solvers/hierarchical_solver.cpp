#include "solver/transport/solvers/hierarchical_solver.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "solver/base/parallel.h"
#include "solver/base/stopwatch.h"
#include "solver/transport/points/leaf_cells.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/solvers/closure.h"
#include "solver/transport/sources/leaf_fragments.h"

namespace penumbra {
namespace {

constexpr std::size_t kExactGrain = 8;  // leaves that a task corrects
// Radiosities below this share of what the fronts reflect on the whole count as that much, where sources are
// cut.
constexpr double kDark = 0.5;
// By what passes that prepare the parts of leaves may err, and how it falls: by about what a pass gains.
constexpr double kCoarsestCells = 0.1, kCellStep = 4;
// Below this a pass that cuts nothing further is the last of them.
constexpr double kFineCells = 1e-3;

// How multigridding begins, and by what the bound falls from one iteration to the next. Coarse links need not
// settle better than this.
constexpr double kCoarsestEps = 64;  // x eps
constexpr double kEpsStep = 4;
constexpr double kCoarseCutoff = 0.01;

// Rooms are nearly white where so much light is still to come for each unit that is there: reflectances above
// 0.95. Below that the links' errors, some thousandths, come back some twenty times, which corrections mend.
constexpr double kNearlyWhite = 20;

// The area of an element for which eps is meant: a 16 x 16 mesh of all fronts together.
double ReferenceArea(const Scene& scene) {
  double area = 0;
  for (const Patch& patch : scene.patches) area += patch.area;
  return area / 256;
}

// Nothing if it was cancelled.
std::optional<LinkSet> LinkRoots(const ElementForest& forest, const PatchVisibility& visibility,
                                 LinkFormFactors form_factors, const ExecutionContext& context) {
  std::vector<LinkGroup> groups(forest.size());
  for (std::size_t p = 0; p < groups.size(); ++p) {
    if (context.Cancelled()) return std::nullopt;
    groups[p].receiver = ElementForest::Root(static_cast<PatchId>(p));
    for (const PatchPair& pair : visibility.SourcesOf(static_cast<PatchId>(p)))
      groups[p].candidates.push_back({ElementForest::Root(pair.source), visibility.Blockers(pair)});
  }
  const std::vector<LinkSet> formed = FormLinkGroups(forest, groups, form_factors, context);
  if (context.Cancelled()) return std::nullopt;
  LinkSet links = ReplaceLinks({}, {}, formed, context);
  if (context.Cancelled()) return std::nullopt;
  return links;
}

// How many links there would be at most, once a plan is done.
std::size_t CountLinks(const RadiositySolution& solution, const RefinementPlan& plan) {
  std::size_t count = solution.links.links.size() - plan.links_split;
  for (const LinkGroup& group : plan.groups) count += group.candidates.size();
  return count;
}

}  // namespace

struct HierarchicalSolver::Snapshot {
  std::size_t elements = 0;
  std::optional<LinkSet> links;  // once they have been replaced
  std::vector<Fragment> fragments;
  std::vector<Rgb> irradiance, radiosity;
  std::vector<double> radiosity_spread, spread_below;
  std::vector<Rgb> correction, fragment_offset;
  bool converged = false;
};

HierarchicalSolver::Snapshot HierarchicalSolver::TakeSnapshot() const {
  const RadiositySolution& s = solution_;
  return {s.forest.size(),    std::nullopt,   s.fragments, s.irradiance,     s.radiosity,
          s.radiosity_spread, s.spread_below, correction_, fragment_offset_, converged_};
}

void HierarchicalSolver::Restore(Snapshot before) {
  if (solution_.forest.size() != before.elements) seen_from_leaves_.reset();
  solution_.forest.Truncate(before.elements);
  if (before.links) solution_.links = std::move(*before.links);
  solution_.fragments = std::move(before.fragments);
  solution_.irradiance = std::move(before.irradiance);
  solution_.radiosity = std::move(before.radiosity);
  solution_.radiosity_spread = std::move(before.radiosity_spread);
  solution_.spread_below = std::move(before.spread_below);
  correction_ = std::move(before.correction);
  closure_.resize(std::min(closure_.size(), before.elements));
  fragment_offset_ = std::move(before.fragment_offset);
  converged_ = before.converged;
  push_pull_->Update();
}

bool IsStuck(std::span<const IterationReport> reports) {
  constexpr double kNearer = 0.9;  // that an iteration without new links brings the light at least
  if (reports.size() < 2) return false;
  const IterationReport &last = reports[reports.size() - 1], &before = reports[reports.size() - 2];
  return last.links_split == 0 && before.links_split == 0 && last.eps == before.eps &&
         !(last.residual < kNearer * before.residual);
}

HierarchicalSolver::HierarchicalSolver(const Scene& scene, const PatchVisibility& visibility,
                                       const SolverOptions& options, const ExecutionContext& context)
    : scene_(scene),
      visibility_(visibility),
      options_(options),
      eps_(options.multigrid ? kCoarsestEps * options.eps : options.eps) {
  solution_.forest = ElementForest(scene);
  std::optional<LinkSet> links = LinkRoots(solution_.forest, visibility, options.form_factors, context);
  linked_ = links.has_value();
  if (links) solution_.links = std::move(*links);
  root_links_ = solution_.links.links.size();
  push_pull_ = std::make_unique<PushPull>(solution_);
}

HierarchicalSolver::HierarchicalSolver(const Scene& scene, const PatchVisibility& visibility,
                                       const SolverOptions& options, RadiositySolution solution,
                                       const ExecutionContext& context)
    : scene_(scene),
      visibility_(visibility),
      options_(options),
      eps_(options.eps),
      solution_(std::move(solution)),
      push_pull_(std::make_unique<PushPull>(solution_)) {
  Balance(context);
  // What corrected a leaf is what its links do not bring.
  const std::vector<Rgb> linked = push_pull_->Transport(solution_.radiosity);
  correction_.assign(solution_.forest.size(), Rgb::Zero());
  for (const ElementId leaf : push_pull_->leaves())
    correction_[leaf] = solution_.irradiance[leaf] - linked[leaf];
  for (const Fragment& fragment : solution_.fragments)
    fragment_offset_.push_back(fragment.irradiance - solution_.irradiance[fragment.leaf]);
}

HierarchicalSolver::~HierarchicalSolver() = default;

// Brings the links into balance where the room is nearly white. False if it was cancelled.
bool HierarchicalSolver::Balance(const ExecutionContext& context) {
  if (push_pull_->IsBalanced()) return !context.Cancelled();
  if (!nearly_white_) {
    double whitest = 0;
    for (const Patch& patch : scene_.patches)
      whitest = std::max(whitest, scene_.materials[patch.material].reflectance.maxCoeff());
    nearly_white_ = whitest > kNearlyWhite / (1 + kNearlyWhite) &&
                    LightToCome(*push_pull_, solution_, context).maxCoeff() > kNearlyWhite;
  }
  if (!*nearly_white_) return !context.Cancelled();
  closure_.resize(solution_.forest.size(), -1);
  std::vector<ElementId> unknown;
  for (const ElementId leaf : push_pull_->leaves())
    if (closure_[static_cast<std::size_t>(leaf)] < 0) unknown.push_back(leaf);
  const std::vector<double> found = LeafClosures(solution_.forest, visibility_, unknown, context);
  if (context.Cancelled()) return false;
  for (std::size_t i = 0; i < unknown.size(); ++i) closure_[static_cast<std::size_t>(unknown[i])] = found[i];
  std::vector<double> closure;
  for (const ElementId leaf : push_pull_->leaves())
    closure.push_back(closure_[static_cast<std::size_t>(leaf)]);
  push_pull_->Balance(closure);
  return true;
}

double HierarchicalSolver::PartOfTolerance() const {
  return to_come_ > kNearlyWhite ? kNearlyWhite / to_come_ : 1;
}

PointIrradianceOptions HierarchicalSolver::HowToSample() const {
  PointIrradianceOptions options;
  options.part_of_tolerance = PartOfTolerance();
  return options;
}

bool HierarchicalSolver::Settle(double cutoff, IterationReport& report, const ExecutionContext& context) {
  if (!Balance(context)) return false;
  const Settled settled = penumbra::Settle(*push_pull_, solution_, correction_,
                                           {options_.scheme, options_.acceleration, cutoff}, context);
  report.residual = settled.residual;
  report.sweeps += settled.sweeps;
  to_come_ = settled.to_come;
  return !context.Cancelled();
}

// Forms the links of the plan and puts them in their place. False if it was cancelled before that.
bool HierarchicalSolver::Apply(const RefinementPlan& plan, Snapshot& before,
                               const ExecutionContext& context) {
  seen_from_leaves_.reset();
  const std::vector<LinkSet> formed =
      FormLinkGroups(solution_.forest, plan.groups, options_.form_factors, context);
  if (context.Cancelled()) return false;
  LinkSet links = ReplaceLinks(solution_.links, plan.dropped, formed, context);
  if (context.Cancelled()) return false;
  LinkSet replaced = std::exchange(solution_.links, std::move(links));
  if (!before.links) before.links = std::move(replaced);
  TakeCorrectionsBack();
  push_pull_->Update();
  return true;
}

// What corrected the old leaves says nothing of new ones, or of other light.
void HierarchicalSolver::TakeCorrectionsBack() {
  solution_.fragments.clear();
  fragment_offset_.clear();
  correction_.clear();
  leaf_parts_.clear();
}

std::optional<IterationReport> HierarchicalSolver::Iterate(const ExecutionContext& context) {
  const Stopwatch stopwatch;
  Snapshot before = TakeSnapshot();
  IterationReport report;
  report.eps = eps_;
  const double cutoff = std::max(options_.relative_cutoff,
                                 std::min(kCoarseCutoff, options_.relative_cutoff * eps_ / options_.eps));
  bool going = Settle(cutoff, report, context);
  const auto oracle = MakeOracle(options_.oracle, {eps_, options_.min_area, ReferenceArea(scene_)});
  while (going) {
    const std::size_t elements = solution_.forest.size();
    const RefinementPlan plan = PlanRefinement(solution_, *push_pull_, *oracle);
    if (plan.links_split == 0) break;
    if (CountLinks(solution_, plan) > root_links_ + options_.max_links) {
      solution_.forest.Truncate(elements);
      full_ = true;
      break;
    }
    report.links_split += plan.links_split;
    going = Apply(plan, before, context);
  }
  if (going && report.links_split > 0) {
    for (std::size_t p = 0; p < scene_.patches.size(); ++p) solution_.forest.Balance(static_cast<PatchId>(p));
    push_pull_->Update();
    // The new links carry light at once, so that what is left is a solution on all of them.
    going = Settle(cutoff, report, context);
  }
  if (!going) {
    Restore(std::move(before));
    return std::nullopt;
  }
  const bool refined = full_ || (eps_ == options_.eps && report.links_split == 0);
  converged_ = refined && report.residual <= options_.relative_cutoff;
  eps_ = std::max(options_.eps, eps_ / kEpsStep);
  report.elements = solution_.forest.size();
  report.links = solution_.links.links.size();
  report.seconds = stopwatch.Seconds();
  return report;
}

bool HierarchicalSolver::SubdivideLeaves(std::span<const ElementId> leaves, const ExecutionContext& context) {
  Snapshot before = TakeSnapshot();
  const RefinementPlan plan = PlanSubdivision(solution_, *push_pull_, leaves);
  if (solution_.forest.size() == before.elements) return !context.Cancelled();
  bool going = Apply(plan, before, context);
  if (going) {
    for (std::size_t p = 0; p < scene_.patches.size(); ++p) solution_.forest.Balance(static_cast<PatchId>(p));
    push_pull_->Update();
    IterationReport ignored;
    going = Settle(options_.relative_cutoff, ignored, context);
  }
  if (going)
    converged_ = false;
  else
    Restore(std::move(before));
  return going;
}

std::optional<IterationReport> HierarchicalSolver::Relight(const ExecutionContext& context) {
  const Stopwatch stopwatch;
  Snapshot before = TakeSnapshot();
  TakeCorrectionsBack();
  nearly_white_.reset();
  push_pull_->Update();
  for (const ElementId leaf : push_pull_->leaves()) push_pull_->Light(leaf, solution_.irradiance[leaf]);
  push_pull_->Pull();
  IterationReport report;
  if (!Settle(options_.relative_cutoff, report, context)) {
    Restore(std::move(before));
    return std::nullopt;
  }
  converged_ = false;
  report.eps = options_.eps;
  report.elements = solution_.forest.size();
  report.links = solution_.links.links.size();
  report.seconds = stopwatch.Seconds();
  return report;
}

std::optional<double> HierarchicalSolver::CorrectByCells(double error, const ExecutionContext& context) {
  const ElementForest& forest = solution_.forest;
  std::vector<ElementId> leaves = forest.AllLeaves();
  std::sort(leaves.begin(), leaves.end());
  const LeafCellOptions options = {error, kDark * MeanReflected(solution_), options_.min_area};
  std::vector<std::vector<Polygon3>> parts = leaf_parts_;
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
  const PointIrradiance exact(solution_, visibility_, HowToSample(), seen);
  std::vector<std::vector<Fragment>> pieces(leaves.size());
  std::vector<Rgb> irradiance(forest.size(), Rgb::Zero());
  ParallelFor(leaves.size(), 1, [&](std::size_t i) {
    if (context.Cancelled()) return;
    const ElementId leaf = leaves[i];
    Rgb& mean = irradiance[static_cast<std::size_t>(leaf)];
    if ((scene_.MaterialOf(forest[leaf].patch).reflectance == 0).all()) {
      mean = ExactLeafIrradiance(solution_, exact, leaf, LeafSampling::kCubature).mean;
      return;
    }
    LeafCells cells = CutLeaf(solution_, exact, leaf, std::move(parts[i]), options);
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
    const double change = (now - solution_.irradiance[leaf]).abs().maxCoeff();
    squares += a * change * change;
    total += a * now.maxCoeff();
    area += a;
    std::move(pieces[i].begin(), pieces[i].end(), std::back_inserter(fragments));
  }
  if (!CorrectTo(irradiance, std::move(fragments), context)) return std::nullopt;
  leaf_parts_ = std::move(parts);
  return total > 0 ? std::sqrt(squares / area) / (total / area) : 0;
}

std::optional<double> HierarchicalSolver::Correct(LeafSampling sampling, const ExecutionContext& context) {
  if (options_.source_error > 0) return CorrectByCells(options_.source_error, context);
  Snapshot before = TakeSnapshot();
  if (fragment_offset_.empty()) {
    solution_.fragments = CutLeavesAtContacts(solution_.forest, context);
    fragment_offset_.assign(solution_.fragments.size(), Rgb::Zero());
    LightFragments();
  }
  const std::span<const ElementId> leaves = push_pull_->leaves();
  const std::shared_ptr<const LeafVisibility> seen = SeenFromLeaves(context);
  if (!seen) {
    Restore(std::move(before));
    return std::nullopt;
  }
  const PointIrradiance irradiance(solution_, visibility_, HowToSample(), seen);
  std::vector<LeafIrradiance> exact(leaves.size());
  ParallelFor(leaves.size(), kExactGrain, [&](std::size_t i) {
    if (!context.Cancelled())
      exact[i] =
          ExactLeafIrradiance(solution_, irradiance, leaves[i], sampling, options_.correction_tolerance);
  });
  if (context.Cancelled()) {
    Restore(std::move(before));
    return std::nullopt;
  }

  correction_.resize(solution_.forest.size(), Rgb::Zero());
  double squares = 0, mean = 0, area = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const ElementId leaf = leaves[i];
    const double a = solution_.forest[leaf].area;
    const Rgb change = exact[i].mean - solution_.irradiance[leaf];
    correction_[leaf] += change;
    squares += a * change.abs().maxCoeff() * change.abs().maxCoeff();
    mean += a * exact[i].mean.maxCoeff();
    area += a;
    if (exact[i].fragments.empty()) continue;
    const auto first =
        static_cast<std::size_t>(solution_.FragmentsOf(leaf).data() - solution_.fragments.data());
    for (std::size_t f = 0; f < exact[i].fragments.size(); ++f)
      fragment_offset_[first + f] = exact[i].fragments[f] - exact[i].mean;
  }
  IterationReport ignored;
  if (!Settle(options_.relative_cutoff, ignored, context)) {
    Restore(std::move(before));
    return std::nullopt;
  }
  LightFragments();
  return mean > 0 ? std::sqrt(squares / area) / (mean / area) : 0;
}

bool HierarchicalSolver::CorrectTo(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                                   const ExecutionContext& context) {
  Snapshot before = TakeSnapshot();
  correction_.resize(solution_.forest.size(), Rgb::Zero());
  for (const ElementId leaf : solution_.forest.AllLeaves())
    correction_[leaf] += irradiance[static_cast<std::size_t>(leaf)] - solution_.irradiance[leaf];
  solution_.fragments = std::move(fragments);
  fragment_offset_.clear();
  for (const Fragment& fragment : solution_.fragments)
    fragment_offset_.push_back(fragment.irradiance - irradiance[static_cast<std::size_t>(fragment.leaf)]);
  IterationReport ignored;
  if (!Settle(options_.relative_cutoff, ignored, context)) {
    Restore(std::move(before));
    return false;
  }
  LightFragments();
  return true;
}

std::shared_ptr<const LeafVisibility> HierarchicalSolver::SeenFromLeaves(const ExecutionContext& context) {
  if (!seen_from_leaves_) {
    auto seen = std::make_shared<const LeafVisibility>(solution_.forest, visibility_, context);
    if (context.Cancelled()) return nullptr;
    seen_from_leaves_ = std::move(seen);
  }
  return seen_from_leaves_;
}

// The light of fragments: their leaf's, and what sets them apart from it.
void HierarchicalSolver::LightFragments() {
  for (std::size_t i = 0; i < solution_.fragments.size(); ++i) {
    Fragment& fragment = solution_.fragments[i];
    const Material& material = scene_.MaterialOf(solution_.forest[fragment.leaf].patch);
    fragment.irradiance = (solution_.irradiance[fragment.leaf] + fragment_offset_[i]).max(0.0);
    fragment.radiosity = material.emittance + material.reflectance * fragment.irradiance;
  }
}

std::vector<Rgb> HierarchicalSolver::MeanIrradianceByBounce(int bounces) const {
  const ElementForest& forest = solution_.forest;
  std::vector<Rgb> radiosity(forest.size()), means;
  for (std::size_t e = 0; e < forest.size(); ++e)
    radiosity[e] = scene_.MaterialOf(forest.elements()[e].patch).emittance;
  for (int bounce = 0; bounce < bounces; ++bounce) {
    radiosity = push_pull_->Transport(radiosity);
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

bool HierarchicalSolver::CorrectAll(const ExecutionContext& context, bool but_the_last) {
  const bool cells = options_.source_error > 0 && options_.max_corrections > 0;
  const auto parts = [&] {
    std::size_t count = 0;
    for (const std::vector<Polygon3>& leaf : leaf_parts_) count += leaf.size();
    return count;
  };
  for (double error = kCoarsestCells; cells && error > options_.source_error && !context.Cancelled();
       error /= kCellStep) {
    const std::size_t before = parts();
    if (!CorrectByCells(error, context)) break;
    // Where parts are as small as they may become, a smaller error cuts no more.
    if (error < kFineCells && parts() == before) break;
  }
  // All passes but the last only need to come near: the last one, here or by CorrectTo(), replaces what they
  // added.
  const int passes = options_.max_corrections - (but_the_last ? 1 : 0);
  for (int pass = 1; pass <= passes && !context.Cancelled(); ++pass) {
    context.Report("correct", static_cast<double>(pass - 1) / options_.max_corrections);
    Correct(pass < options_.max_corrections ? LeafSampling::kCentroid : LeafSampling::kCubature, context);
  }
  return !context.Cancelled();
}

std::vector<IterationReport> HierarchicalSolver::Solve(const ExecutionContext& context) {
  std::vector<IterationReport> reports;
  while (!converged_ && static_cast<int>(reports.size()) < options_.max_iterations && !context.Cancelled()) {
    const std::optional<IterationReport> report = Iterate(context);
    if (report) reports.push_back(*report);
    if (IsStuck(reports)) break;
    context.Report("iterate", static_cast<double>(reports.size()) / options_.max_iterations);
  }
  CorrectAll(context);
  return reports;
}

}  // namespace penumbra
