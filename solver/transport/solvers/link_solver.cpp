#include "solver/transport/solvers/link_solver.h"

#include <algorithm>
#include <utility>

#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "solver/transport/links/link_former.h"
#include "solver/transport/links/refinement_oracles.h"
#include "solver/transport/solvers/closure.h"

namespace penumbra {
namespace {

// Multigridding starts with kCoarsestEps times eps and divides by kEpsStep after each iteration. For coarse
// links the light settles to kCoarseCutoff.
constexpr double kCoarsestEps = 64;  // x eps
constexpr double kEpsStep = 4;
constexpr double kCoarseCutoff = 0.01;

// The area of an element for which eps is meant: 1/256 of the area of all fronts, a 16 x 16 mesh.
double ReferenceArea(const Scene& scene) {
  double area = 0;
  for (const Patch& patch : scene.patches) area += patch.area;
  return area / 256;
}

// Returns the options. Throws InputError if no method has one of their names.
const SolverOptions& Checked(const SolverOptions& options) {
  RefinementOracles().Find(options.oracle);
  LinkFormFactorMethods().Find(options.form_factors);
  return options;
}

// Links between the roots; nothing if cancelled.
std::optional<LinkSet> LinkRoots(const ElementForest& forest, const PatchVisibility& visibility,
                                 const SolverOptions& options, const ExecutionContext& context) {
  std::vector<LinkGroup> groups(forest.size());
  for (std::size_t p = 0; p < groups.size(); ++p) {
    if (context.Cancelled()) return std::nullopt;
    groups[p].receiver = ElementForest::Root(static_cast<PatchId>(p));
    for (const PatchPair& pair : visibility.SourcesOf(static_cast<PatchId>(p)))
      groups[p].candidates.push_back({ElementForest::Root(pair.source), visibility.Blockers(pair)});
  }
  const auto method = LinkFormFactorMethods().Make(options.form_factors, options.form_factor_options);
  const std::vector<LinkSet> formed = FormLinkGroups(forest, groups, *method, context);
  if (context.Cancelled()) return std::nullopt;
  LinkSet links = ReplaceLinks({}, {}, formed, context);
  if (context.Cancelled()) return std::nullopt;
  return links;
}

// The largest number of links after a plan.
std::size_t CountLinks(const RadiositySolution& solution, const RefinementPlan& plan) {
  std::size_t count = solution.links.links.size() - plan.links_split;
  for (const LinkGroup& group : plan.groups) count += group.candidates.size();
  return count;
}

}  // namespace

bool IsStuck(std::span<const IterationReport> reports) {
  constexpr double kNearer = 0.9;  // factor by which an iteration without new links must reduce the residual
  if (reports.size() < 2) return false;
  const IterationReport &last = reports[reports.size() - 1], &before = reports[reports.size() - 2];
  return last.links_split == 0 && before.links_split == 0 && last.eps == before.eps &&
         !(last.residual < kNearer * before.residual);
}

LinkSolver::LinkSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
                       const ExecutionContext& context)
    : scene_(scene),
      visibility_(visibility),
      options_(Checked(options)),
      eps_(options.multigrid ? kCoarsestEps * options.eps : options.eps) {
  solution_.forest = ElementForest(scene);
  std::optional<LinkSet> links = LinkRoots(solution_.forest, visibility, options, context);
  linked_ = links.has_value();
  if (links) solution_.links = std::move(*links);
  root_links_ = solution_.links.links.size();
  push_pull_ = std::make_unique<PushPull>(solution_);
}

LinkSolver::LinkSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
                       RadiositySolution solution, const ExecutionContext& context)
    : scene_(scene),
      visibility_(visibility),
      options_(Checked(options)),
      eps_(options.eps),
      solution_(std::move(solution)),
      push_pull_(std::make_unique<PushPull>(solution_)) {
  Balance(context);
}

LinkSolver::LinkSolver(const LinkSolver& other, const PatchVisibility& visibility)
    : scene_(other.scene_),
      visibility_(visibility),
      options_(other.options_),
      eps_(other.eps_),
      solution_(other.solution_),
      push_pull_(std::make_unique<PushPull>(solution_)),
      linked_(other.linked_),
      nearly_white_(other.nearly_white_),
      to_come_(other.to_come_),
      closure_(other.closure_),
      converged_(other.converged_),
      full_(other.full_),
      root_links_(other.root_links_) {
  if (other.push_pull_->IsBalanced()) Balance(ExecutionContext());  // all closures are known
}

LinkSolver::Snapshot LinkSolver::TakeSnapshot() const {
  const RadiositySolution& s = solution_;
  return {s.forest.size(), std::nullopt,       s.fragments,    s.irradiance,
          s.radiosity,     s.radiosity_spread, s.spread_below, converged_};
}

bool LinkSolver::Restore(Snapshot before) {
  const bool other_elements = solution_.forest.size() != before.elements;
  solution_.forest.Truncate(before.elements);
  if (before.links) solution_.links = std::move(*before.links);
  solution_.fragments = std::move(before.fragments);
  solution_.irradiance = std::move(before.irradiance);
  solution_.radiosity = std::move(before.radiosity);
  solution_.radiosity_spread = std::move(before.radiosity_spread);
  solution_.spread_below = std::move(before.spread_below);
  closure_.resize(std::min(closure_.size(), before.elements));
  converged_ = before.converged;
  push_pull_->Update();
  return other_elements;
}

// Brings the links into balance if the room is nearly white. False if cancelled.
bool LinkSolver::Balance(const ExecutionContext& context) {
  if (push_pull_->IsBalanced()) return !context.Cancelled();
  if (!nearly_white_) {
    double whitest = 0;
    for (const Patch& patch : scene_.patches)
      whitest = std::max(whitest, scene_.materials[patch.material].reflectance.maxCoeff());
    const bool nearly_white = whitest > kNearlyWhite / (1 + kNearlyWhite) &&
                              LightToCome(*push_pull_, solution_, context).maxCoeff() > kNearlyWhite;
    if (context.Cancelled()) return false;
    nearly_white_ = nearly_white;
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

bool LinkSolver::Settle(std::span<const Rgb> correction, double cutoff, IterationReport& report,
                        const ExecutionContext& context) {
  return SettleBy({options_.scheme, options_.acceleration, cutoff}, correction, report, context);
}

bool LinkSolver::Sweep(std::span<const Rgb> correction, IterationReport& report,
                       const ExecutionContext& context) {
  return SettleBy({options_.scheme, Acceleration::kNone, options_.relative_cutoff, 1}, correction, report,
                  context);
}

bool LinkSolver::SettleBy(const SettlingOptions& how, std::span<const Rgb> correction,
                          IterationReport& report, const ExecutionContext& context) {
  if (!Balance(context)) return false;
  const Settled settled = penumbra::Settle(*push_pull_, solution_, correction, how, context);
  report.residual = settled.residual;
  report.sweeps += settled.sweeps;
  to_come_ = settled.to_come;
  return !context.Cancelled();
}

double LinkSolver::Cutoff() const {
  return std::max(options_.relative_cutoff,
                  std::min(kCoarseCutoff, options_.relative_cutoff * eps_ / options_.eps));
}

// Forms the links of the plan and replaces the dropped links. False if cancelled before the replacement.
bool LinkSolver::Apply(const RefinementPlan& plan, Snapshot& before, const ExecutionContext& context) {
  const auto method = LinkFormFactorMethods().Make(options_.form_factors, options_.form_factor_options);
  const std::vector<LinkSet> formed = FormLinkGroups(solution_.forest, plan.groups, *method, context);
  if (context.Cancelled()) return false;
  LinkSet links = ReplaceLinks(solution_.links, plan.dropped, formed, context);
  if (context.Cancelled()) return false;
  LinkSet replaced = std::exchange(solution_.links, std::move(links));
  if (!before.links) before.links = std::move(replaced);
  solution_.fragments.clear();
  push_pull_->Update();
  return true;
}

bool LinkSolver::Split(Snapshot& before, IterationReport& report, const ExecutionContext& context,
                       int most_levels) {
  const auto oracle =
      RefinementOracles().Make(options_.oracle, {eps_, options_.min_area, ReferenceArea(scene_)});
  for (int level = 0; most_levels == 0 || level < most_levels; ++level) {
    const std::size_t elements = solution_.forest.size();
    const RefinementPlan plan = PlanRefinement(solution_, *push_pull_, *oracle);
    if (plan.links_split == 0) break;
    if (CountLinks(solution_, plan) > root_links_ + options_.max_links) {
      solution_.forest.Truncate(elements);
      full_ = true;
      break;
    }
    report.links_split += plan.links_split;
    if (!Apply(plan, before, context)) return false;
  }
  if (report.links_split > 0) {
    for (std::size_t p = 0; p < scene_.patches.size(); ++p) solution_.forest.Balance(static_cast<PatchId>(p));
    push_pull_->Update();
  }
  return true;
}

void LinkSolver::EndIteration(IterationReport& report) {
  const bool refined = full_ || (eps_ == options_.eps && report.links_split == 0);
  converged_ = refined && report.residual <= options_.relative_cutoff;
  eps_ = std::max(options_.eps, eps_ / kEpsStep);
  report.elements = solution_.forest.size();
  report.links = solution_.links.links.size();
}

void LinkSolver::ReflectAnew() {
  nearly_white_.reset();
  converged_ = false;
  push_pull_->Update();
  for (const ElementId leaf : push_pull_->leaves()) push_pull_->Light(leaf, solution_.irradiance[leaf]);
  push_pull_->Pull();
}

}  // namespace penumbra
