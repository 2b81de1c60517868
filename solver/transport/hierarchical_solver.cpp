#include "solver/transport/hierarchical_solver.h"

#include <algorithm>
#include <cmath>

#include "solver/base/parallel.h"
#include "solver/base/stopwatch.h"
#include "solver/transport/anderson.h"
#include "solver/transport/leaf_fragments.h"
#include "solver/transport/leaf_irradiance.h"
#include "solver/transport/link_former.h"
#include "solver/transport/point_irradiance.h"

namespace penumbra {
namespace {

// Elements a task gathers, receivers it links, leaves it corrects.
constexpr std::size_t kGatherGrain = 256;
constexpr std::size_t kLinkGrain = 2;
constexpr std::size_t kExactGrain = 8;

// The most sweeps before an iteration refines all the same: without acceleration rooms of reflectance 0.99
// need some 1,400.
constexpr std::size_t kMaxSweeps = 5000;

// The area of an element for which eps is meant: a 16 x 16 mesh of all fronts together.
double ReferenceArea(const Scene& scene) {
  double area = 0;
  for (const Patch& patch : scene.patches) area += patch.area;
  return area / 256;
}

double MaxReflectance(const Scene& scene) {
  double reflectance = 0;
  for (const Patch& patch : scene.patches)
    reflectance = std::max(reflectance, scene.materials[patch.material].reflectance.maxCoeff());
  return reflectance;
}

}  // namespace

struct HierarchicalSolver::Group {
  ElementId receiver;
  std::vector<LinkCandidate> candidates;
};

struct HierarchicalSolver::Snapshot {
  std::size_t elements = 0;
  std::optional<LinkSet> links;  // once they have been replaced
  std::vector<Fragment> fragments;
  std::vector<Rgb> irradiance, radiosity;
  std::vector<double> radiosity_spread, spread_below;
  std::vector<Rgb> gathered, correction, fragment_offset;
  double residual = 1;
  bool converged = false;
};

HierarchicalSolver::Snapshot HierarchicalSolver::TakeSnapshot() const {
  Snapshot before;
  before.elements = solution_.forest.size();
  before.fragments = solution_.fragments;
  before.irradiance = solution_.irradiance;
  before.radiosity = solution_.radiosity;
  before.radiosity_spread = solution_.radiosity_spread;
  before.spread_below = solution_.spread_below;
  before.gathered = gathered_;
  before.correction = correction_;
  before.fragment_offset = fragment_offset_;
  before.residual = residual_;
  before.converged = converged_;
  return before;
}

void HierarchicalSolver::Restore(Snapshot before) {
  solution_.forest.Truncate(before.elements);
  if (before.links) solution_.links = std::move(*before.links);
  solution_.fragments = std::move(before.fragments);
  solution_.irradiance = std::move(before.irradiance);
  solution_.radiosity = std::move(before.radiosity);
  solution_.radiosity_spread = std::move(before.radiosity_spread);
  solution_.spread_below = std::move(before.spread_below);
  gathered_ = std::move(before.gathered);
  correction_ = std::move(before.correction);
  fragment_offset_ = std::move(before.fragment_offset);
  residual_ = before.residual;
  converged_ = before.converged;
  IndexLinks();
}

HierarchicalSolver::HierarchicalSolver(const Scene& scene, const PatchVisibility& visibility,
                                       const SolverOptions& options)
    : scene_(scene),
      visibility_(visibility),
      options_(options),
      oracle_(options.eps, options.min_area, ReferenceArea(scene)) {
  solution_.forest = ElementForest(scene);
  std::vector<LinkSet> roots(scene.patches.size());
  ParallelFor(roots.size(), kLinkGrain, [&](std::size_t p) {
    std::vector<LinkCandidate> candidates;
    for (const PatchPair& pair : visibility.SourcesOf(static_cast<PatchId>(p)))
      candidates.push_back({ElementForest::Root(pair.source), visibility.Blockers(pair)});
    roots[p] = FormLinks(solution_.forest, ElementForest::Root(static_cast<PatchId>(p)), candidates,
                         options_.form_factors);
  });
  Install(std::move(roots), {});
  ResizeLight();
  for (std::size_t p = 0; p < scene.patches.size(); ++p)
    solution_.radiosity[p] = scene.materials[scene.patches[p].material].emittance;
}

HierarchicalSolver::HierarchicalSolver(const Scene& scene, const PatchVisibility& visibility,
                                       const SolverOptions& options, RadiositySolution solution)
    : scene_(scene),
      visibility_(visibility),
      options_(options),
      oracle_(options.eps, options.min_area, ReferenceArea(scene)),
      solution_(std::move(solution)) {
  IndexLinks();
  ResizeLight();
  // What corrected a leaf is what its links do not bring.
  const std::vector<Rgb> irradiance = solution_.irradiance;
  Sweep();
  for (const ElementId leaf : solution_.forest.AllLeaves()) {
    correction_[leaf] = irradiance[leaf] - solution_.irradiance[leaf];
    Light(leaf, irradiance[leaf]);
  }
  for (std::size_t p = 0; p < scene_.patches.size(); ++p) Pull(ElementForest::Root(static_cast<PatchId>(p)));
  for (const Fragment& fragment : solution_.fragments)
    fragment_offset_.push_back(fragment.irradiance - irradiance[fragment.leaf]);
}

// Replaces the links by those not dropped and the groups' new ones, ordered by receiver, then source. Returns
// the old ones.
LinkSet HierarchicalSolver::Install(std::vector<LinkSet> groups, const std::vector<char>& dropped) {
  struct Origin {
    const LinkSet* set;
    const Link* link;
  };
  std::vector<Origin> origins;
  for (std::size_t i = 0; i < solution_.links.links.size(); ++i)
    if (dropped.empty() || !dropped[i]) origins.push_back({&solution_.links, &solution_.links.links[i]});
  for (const LinkSet& set : groups)
    for (const Link& link : set.links) origins.push_back({&set, &link});
  std::sort(origins.begin(), origins.end(), [](const Origin& a, const Origin& b) {
    return std::pair(a.link->receiver, a.link->source) < std::pair(b.link->receiver, b.link->source);
  });

  LinkSet merged;
  merged.links.reserve(origins.size());
  for (const Origin& origin : origins) {
    Link link = *origin.link;
    const std::span<const PatchId> blockers = origin.set->Blockers(link);
    link.first_blocker = static_cast<std::uint32_t>(merged.blockers.size());
    merged.blockers.insert(merged.blockers.end(), blockers.begin(), blockers.end());
    merged.links.push_back(link);
  }
  std::swap(solution_.links, merged);
  IndexLinks();
  return merged;
}

void HierarchicalSolver::IndexLinks() {
  first_link_.assign(solution_.forest.size() + 1, 0);
  for (const Link& link : solution_.links.links) ++first_link_[static_cast<std::size_t>(link.receiver) + 1];
  for (std::size_t e = 0; e < solution_.forest.size(); ++e) first_link_[e + 1] += first_link_[e];
}

// Forms the groups' links and puts them in the place of those dropped. False if it was cancelled before that.
bool HierarchicalSolver::Relink(std::span<const Group> groups, const std::vector<char>& dropped,
                                Snapshot& before, const ExecutionContext& context) {
  std::vector<LinkSet> formed(groups.size());
  ParallelFor(groups.size(), kLinkGrain, [&](std::size_t g) {
    if (!context.Cancelled())
      formed[g] =
          FormLinks(solution_.forest, groups[g].receiver, groups[g].candidates, options_.form_factors);
  });
  if (context.Cancelled()) return false;
  LinkSet replaced = Install(std::move(formed), dropped);
  if (!before.links) before.links = std::move(replaced);
  TakeCorrectionsBack();
  ResizeLight();
  return true;
}

// Gives elements that are new the light of their parents.
void HierarchicalSolver::ResizeLight() {
  const std::size_t before = solution_.radiosity.size(), count = solution_.forest.size();
  solution_.irradiance.resize(count, Rgb::Zero());
  solution_.radiosity.resize(count, Rgb::Zero());
  solution_.radiosity_spread.resize(count, 0);
  solution_.spread_below.resize(count, 0);
  gathered_.resize(count, Rgb::Zero());
  correction_.resize(count, Rgb::Zero());
  first_link_.resize(count + 1, solution_.links.links.size());
  for (std::size_t e = before; e < count; ++e) {
    const ElementId parent = solution_.forest[static_cast<ElementId>(e)].parent;
    if (parent == kNoElement) continue;
    solution_.irradiance[e] = solution_.irradiance[parent];
    solution_.radiosity[e] = solution_.radiosity[parent];
  }
}

void HierarchicalSolver::PushPull(ElementId id, const Rgb& from_above) {
  const Element& element = solution_.forest[id];
  const Rgb irradiance = from_above + gathered_[id];
  if (element.IsLeaf()) {
    Light(id, irradiance + correction_[id]);
    return;
  }
  for (ElementId child = element.first_child; child < element.first_child + 4; ++child)
    PushPull(child, irradiance);
  Average(id);
}

// Averages of what is below.
void HierarchicalSolver::Pull(ElementId id) {
  const Element& element = solution_.forest[id];
  if (element.IsLeaf()) return;
  for (ElementId child = element.first_child; child < element.first_child + 4; ++child) Pull(child);
  Average(id);
}

void HierarchicalSolver::Light(ElementId leaf, const Rgb& irradiance) {
  const Material& material = scene_.MaterialOf(solution_.forest[leaf].patch);
  solution_.irradiance[leaf] = irradiance.max(0.0);
  solution_.radiosity[leaf] = material.emittance + material.reflectance * solution_.irradiance[leaf];
  solution_.radiosity_spread[leaf] = 0;
  solution_.spread_below[leaf] = 0;
}

// The area-weighted means of the children, and how much their leaves vary.
void HierarchicalSolver::Average(ElementId id) {
  const Element& element = solution_.forest[id];
  Rgb irradiance_sum = Rgb::Zero(), radiosity_sum = Rgb::Zero();
  double area = 0;
  for (ElementId child = element.first_child; child < element.first_child + 4; ++child) {
    const double a = solution_.forest[child].area;
    irradiance_sum += a * solution_.irradiance[child];
    radiosity_sum += a * solution_.radiosity[child];
    area += a;
  }
  solution_.irradiance[id] = irradiance_sum / area;
  solution_.radiosity[id] = radiosity_sum / area;
  double variance = 0, below_variance = 0;
  for (ElementId child = element.first_child; child < element.first_child + 4; ++child) {
    const double deviation = (solution_.radiosity[child] - solution_.radiosity[id]).abs().maxCoeff();
    const double below = solution_.radiosity_spread[child];
    variance += solution_.forest[child].area * (deviation * deviation + below * below);
    below_variance += solution_.forest[child].area * below * below;
  }
  solution_.spread_below[id] = std::sqrt(below_variance / area);
  solution_.radiosity_spread[id] = std::sqrt(variance / area);
}

// The radiosity with which a link's source shines on its receiver: the mean of its children's, by their
// shares.
Rgb SourceRadiosity(const RadiositySolution& solution, const Link& link) {
  const ElementId first = solution.forest[link.source].first_child;
  if (first == kNoElement) return solution.radiosity[link.source];
  Rgb radiosity = Rgb::Zero();
  for (int q = 0; q < 4; ++q)
    radiosity += static_cast<double>(link.share[static_cast<std::size_t>(q)]) * solution.radiosity[first + q];
  return radiosity;
}

// One sweep: gathers over all links from where the light is, as Jacobi. Returns the largest change of a
// leaf's radiosity, relative to the largest reflected radiosity.
double HierarchicalSolver::Sweep() {
  const RadiositySolution& s = solution_;
  ParallelFor(s.forest.size(), kGatherGrain, [&](std::size_t e) {
    Rgb sum = Rgb::Zero();
    for (std::size_t i = first_link_[e]; i < first_link_[e + 1]; ++i)
      sum += s.links.links[i].form_factor * SourceRadiosity(s, s.links.links[i]);
    gathered_[e] = sum;
  });
  const std::vector<Rgb> before = s.radiosity;
  ParallelFor(scene_.patches.size(), 1,
              [&](std::size_t p) { PushPull(ElementForest::Root(static_cast<PatchId>(p)), Rgb::Zero()); });
  double change = 0, largest = 0;
  for (std::size_t e = 0; e < before.size(); ++e) {
    if (!s.forest[static_cast<ElementId>(e)].IsLeaf()) continue;
    change = std::max(change, (s.radiosity[e] - before[e]).abs().maxCoeff());
    const Material& material = scene_.MaterialOf(s.forest[static_cast<ElementId>(e)].patch);
    largest = std::max(largest, (s.radiosity[e] - material.emittance).maxCoeff());
  }
  return largest > 0 ? change / largest : 0;
}

// Sweeps until what is missing is below the cut-off; returns the bound reached. The change of one sweep
// understates what is missing by 1 / (1 - rho).
double HierarchicalSolver::SweepToCutoff(IterationReport& report, const ExecutionContext& context) {
  const double reflectance = MaxReflectance(scene_);
  const double remaining = reflectance / (1 - reflectance);
  const std::vector<ElementId> leaves = solution_.forest.AllLeaves();
  std::vector<double> area;
  for (const ElementId leaf : leaves) area.push_back(solution_.forest[leaf].area);
  AndersonAcceleration acceleration(std::move(area));
  const auto light_of_leaves = [&] {
    std::vector<Rgb> light;
    for (const ElementId leaf : leaves) light.push_back(solution_.irradiance[leaf]);
    return light;
  };
  residual_ = 1;
  for (std::size_t sweep = 0; sweep < kMaxSweeps && !context.Cancelled(); ++sweep) {
    const std::vector<Rgb> before = light_of_leaves();
    residual_ = Sweep() * remaining;
    ++report.sweeps;
    // What a sweep leaves is bound by its change from wherever it began: a guess need not be good.
    if (residual_ <= options_.relative_cutoff) break;
    // The last word is a sweep's.
    if (!options_.accelerate || context.Cancelled() || sweep + 1 == kMaxSweeps) continue;
    std::vector<Rgb> guess = light_of_leaves();
    acceleration.Improve(before, guess);
    for (std::size_t i = 0; i < leaves.size(); ++i) Light(leaves[i], guess[i]);
    for (std::size_t p = 0; p < scene_.patches.size(); ++p)
      Pull(ElementForest::Root(static_cast<PatchId>(p)));
  }
  return residual_;
}

// Splits every link that the oracle rejects, once. Returns how many.
std::size_t HierarchicalSolver::RefineOnce(Snapshot& before, const ExecutionContext& context) {
  const std::vector<Link>& links = solution_.links.links;
  std::vector<Refinement> verdict(links.size());
  ParallelFor(links.size(), kGatherGrain,
              [&](std::size_t i) { verdict[i] = oracle_.Judge(solution_, links[i]); });

  std::vector<char> dropped(links.size(), 0);
  std::size_t split = 0;
  std::vector<Group> groups;
  for (std::size_t begin = 0; begin < links.size();) {
    const ElementId receiver = links[begin].receiver;
    std::size_t end = begin;
    std::vector<LinkCandidate> down, here;
    for (; end < links.size() && links[end].receiver == receiver; ++end) {
      const Link& link = links[end];
      if (verdict[end] == Refinement::kAccept) continue;
      dropped[end] = 1;
      ++split;
      const std::span<const PatchId> blockers = solution_.links.Blockers(link);
      if (verdict[end] == Refinement::kSplitReceiver) {
        down.push_back({link.source, blockers});
      } else {
        const ElementId first = solution_.forest[link.source].first_child;
        for (ElementId child = first; child < first + 4; ++child) here.push_back({child, blockers});
      }
    }
    if (!down.empty()) {
      const ElementId first = solution_.forest[receiver].IsLeaf() ? solution_.forest.Subdivide(receiver)
                                                                  : solution_.forest[receiver].first_child;
      for (ElementId child = first; child < first + 4; ++child) groups.push_back({child, down});
    }
    if (!here.empty()) groups.push_back({receiver, std::move(here)});
    begin = end;
  }
  return split > 0 && Relink(groups, dropped, before, context) ? split : 0;
}

// What corrected the old leaves says nothing of new ones, or of other light.
void HierarchicalSolver::TakeCorrectionsBack() {
  solution_.fragments.clear();
  fragment_offset_.clear();
  std::fill(correction_.begin(), correction_.end(), Rgb::Zero());
}

void HierarchicalSolver::Balance() {
  for (std::size_t p = 0; p < scene_.patches.size(); ++p) solution_.forest.Balance(static_cast<PatchId>(p));
  ResizeLight();
}

std::optional<IterationReport> HierarchicalSolver::Iterate(const ExecutionContext& context) {
  const Stopwatch stopwatch;
  Snapshot before = TakeSnapshot();
  IterationReport report;
  report.residual = SweepToCutoff(report, context);
  while (!context.Cancelled()) {
    const std::size_t split = RefineOnce(before, context);
    report.links_split += split;
    if (split == 0) break;
  }
  if (report.links_split > 0 && !context.Cancelled()) {
    Balance();
    // The new links carry light at once, so that what is left is a solution on all of them.
    report.residual = SweepToCutoff(report, context);
  }
  if (context.Cancelled()) {
    Restore(std::move(before));
    return std::nullopt;
  }
  converged_ = report.links_split == 0 && report.residual <= options_.relative_cutoff;
  report.elements = solution_.forest.size();
  report.links = solution_.links.links.size();
  report.seconds = stopwatch.Seconds();
  return report;
}

bool HierarchicalSolver::SubdivideLeaves(std::span<const ElementId> leaves, const ExecutionContext& context) {
  Snapshot before = TakeSnapshot();
  std::vector<char> dropped(solution_.links.links.size(), 0);
  std::vector<Group> groups;
  for (const ElementId leaf : leaves) {
    if (!solution_.forest[leaf].IsLeaf() || solution_.forest[leaf].level >= kMaxLevel) continue;
    std::vector<LinkCandidate> own;
    for (std::size_t i = first_link_[leaf]; i < first_link_[static_cast<std::size_t>(leaf) + 1]; ++i) {
      const Link& link = solution_.links.links[i];
      own.push_back({link.source, solution_.links.Blockers(link)});
      dropped[i] = 1;
    }
    const ElementId first = solution_.forest.Subdivide(leaf);
    for (ElementId child = first; child < first + 4; ++child) groups.push_back({child, own});
  }
  IterationReport ignored;
  if (!groups.empty() && Relink(groups, dropped, before, context)) {
    Balance();
    SweepToCutoff(ignored, context);
    converged_ = false;
  }
  if (!context.Cancelled()) return true;
  Restore(std::move(before));
  return false;
}

bool HierarchicalSolver::Relight(const ExecutionContext& context) {
  Snapshot before = TakeSnapshot();
  TakeCorrectionsBack();
  for (const ElementId leaf : solution_.forest.AllLeaves()) Light(leaf, solution_.irradiance[leaf]);
  for (std::size_t p = 0; p < scene_.patches.size(); ++p) Pull(ElementForest::Root(static_cast<PatchId>(p)));
  IterationReport ignored;
  SweepToCutoff(ignored, context);
  converged_ = false;
  if (!context.Cancelled()) return true;
  Restore(std::move(before));
  return false;
}

std::optional<double> HierarchicalSolver::Correct(LeafSampling sampling, const ExecutionContext& context) {
  Snapshot before = TakeSnapshot();
  if (fragment_offset_.empty()) {
    solution_.fragments = CutLeavesAtContacts(solution_.forest);
    fragment_offset_.assign(solution_.fragments.size(), Rgb::Zero());
    LightFragments();
  }
  const std::vector<ElementId> leaves = solution_.forest.AllLeaves();
  const PointIrradiance irradiance(solution_, visibility_);
  std::vector<LeafIrradiance> exact(leaves.size());
  ParallelFor(leaves.size(), kExactGrain, [&](std::size_t i) {
    if (!context.Cancelled()) exact[i] = ExactLeafIrradiance(solution_, irradiance, leaves[i], sampling);
  });
  if (context.Cancelled()) {
    Restore(std::move(before));
    return std::nullopt;
  }

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
  SweepToCutoff(ignored, context);
  if (context.Cancelled()) {
    Restore(std::move(before));
    return std::nullopt;
  }
  LightFragments();
  return mean > 0 ? std::sqrt(squares / area) / (mean / area) : 0;
}

bool HierarchicalSolver::CorrectTo(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                                   const ExecutionContext& context) {
  Snapshot before = TakeSnapshot();
  for (const ElementId leaf : solution_.forest.AllLeaves())
    correction_[leaf] += irradiance[static_cast<std::size_t>(leaf)] - solution_.irradiance[leaf];
  solution_.fragments = std::move(fragments);
  fragment_offset_.clear();
  for (const Fragment& fragment : solution_.fragments)
    fragment_offset_.push_back(fragment.irradiance - irradiance[static_cast<std::size_t>(fragment.leaf)]);
  IterationReport ignored;
  SweepToCutoff(ignored, context);
  if (context.Cancelled()) {
    Restore(std::move(before));
    return false;
  }
  LightFragments();
  return true;
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

bool HierarchicalSolver::CorrectAll(const ExecutionContext& context) {
  // All passes but the last only need to come near: the last one replaces what they added.
  for (int pass = 1; pass <= options_.max_corrections && !context.Cancelled(); ++pass) {
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
    context.Report("iterate", static_cast<double>(reports.size()) / options_.max_iterations);
  }
  CorrectAll(context);
  return reports;
}

}  // namespace penumbra
