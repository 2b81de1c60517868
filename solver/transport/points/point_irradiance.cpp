#include "solver/transport/points/point_irradiance.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/base/processes.h"
#include "solver/base/scratch.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/gathering.h"
#include "solver/transport/points/neighbour_groups.h"
#include "solver/transport/points/sample_bytes.h"
#include "solver/visibility/exact/backprojection.h"
#include "solver/visibility/point/form_factor.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {

namespace {

// With fewer sources, a search for screens costs more than it saves.
constexpr std::size_t kManySources = 16;

// The largest number of screens of a point, and their smallest solid angle [sr].
constexpr std::size_t kMostScreens = 16;
constexpr double kLeastScreen = 0.02;

// If the unoccluded light of the sources exceeds the arriving light by more than this factor, errors relative
// to the unoccluded light are too large: a dark corner that sees a small part of a bright source.
constexpr double kMostlyHidden = 4;

// The terms of a source are gathered with an error of at most about the tolerance each, of either sign. They
// stay valid while the sum of the sizes of their errors is at most this times the tolerance.
constexpr double kHolds = 8;

// Values that the user asks for get more rays than the nodes of a mesh, in other directions.
constexpr std::size_t kCloserRays = 4;
constexpr int kCloserDivisions = 6;
constexpr double kCloserAbove = 0.005;
// At nodes of a mesh, an emitter that is partly hidden gets 1 / kRaysForHidden of the rays for reflected
// light. Above kMostForHidden it is cut by its blockers, which costs no more and has no error.
constexpr std::size_t kRaysForHidden = 4, kMostForHidden = 256;

FinalGatherOptions AtNodes(std::size_t rays) {
  FinalGatherOptions options;
  options.rays = rays;
  const std::size_t for_hidden = rays / kRaysForHidden;
  options.shadows.rays_if_hidden = for_hidden > kMostForHidden ? 0 : static_cast<int>(for_hidden);
  return options;
}

FinalGatherOptions Closer(FinalGatherOptions options) {
  options.rays *= kCloserRays;
  options.seed += 1;
  options.shadows.divisions = kCloserDivisions;
  options.shadows.closer_above = kCloserAbove;
  options.shadows.rays_if_hidden = 0;
  return options;
}

PointIrradianceResult Sampled(const FinalGather& gather, const ReceiverPoint& at, IrradianceParts* parts) {
  return {gather.At(at, parts), gather.AreOneSided({&at, 1}) != 0, nullptr};
}

// A source with an estimate of its unoccluded light.
struct RankedSource {
  double light;  // estimate, in the brightest channel
  Rgb rest;      // upper bound for this source and all sources after it
  const PatchPair* pair;
};

}  // namespace

PointIrradiance::PointIrradiance(const RadiositySolution& solution, const PatchVisibility& visibility,
                                 const PointIrradianceOptions& options,
                                 std::shared_ptr<const LeafVisibility> leaves)
    : scene_(solution.forest.scene()),
      visibility_(visibility),
      forest_(&solution.forest),
      // Where rays bring the light, the leaves are not needed as sources, and would take most of the memory.
      sources_(solution.rays_per_point > 0 ? SourceSet::Emitters(solution.forest.scene())
                                           : SourceSet::FromSolution(solution)),
      leaves_(leaves ? std::move(leaves) : std::make_shared<LeafVisibility>(solution.forest, visibility)),
      options_(options) {
  ChooseMethod();
  BuildHierarchies();
  if (solution.rays_per_point == 0) return;
  gather_.emplace(solution, AtNodes(solution.rays_per_point));
  closer_gather_ = gather_->With(Closer(gather_->options()));
}

PointIrradiance::PointIrradiance(const Scene& scene, const PatchVisibility& visibility, SourceSet sources,
                                 const PointIrradianceOptions& options)
    : scene_(scene), visibility_(visibility), sources_(std::move(sources)), options_(options) {
  ChooseMethod();
  BuildHierarchies();
}

void PointIrradiance::ChooseMethod() {
  if (options_.method || options_.min_backprojection_segment <= 0) return;
  method_ = std::make_shared<const Backprojection>(options_.min_backprojection_segment);
  options_.method = method_.get();
}

void PointIrradiance::BuildHierarchies() {
  std::vector<PatchId> all(scene_.patches.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<PatchId> bright;
  for (const PatchId p : all)
    if (!sources_.Tree(p).empty()) bright.push_back(p);
  patches_ = PatchHierarchy(scene_, std::move(all));
  screens_ = ScreenFinder(scene_);
  source_patches_ = PatchHierarchy(scene_, std::move(bright));
}

ReceiverPoint PointIrradiance::Nudged(const ReceiverPoint& at) const {
  ReceiverPoint moved = at;
  if (options_.nudge > 0 && !at.approach.isZero(0)) {
    moved.position += options_.nudge * at.approach.normalized();
    moved.approach.setZero();
  }
  return moved;
}

PointIrradiance PointIrradiance::WithSources(SourceSet sources) const {
  PointIrradiance other(scene_, visibility_, std::move(sources), options_);
  other.forest_ = forest_;
  other.leaves_ = leaves_;
  other.method_ = method_;
  return other;
}

// GatherOnPatch() with the sources in descending order of their estimated unoccluded light. May leave out the
// last sources if all of them together are negligible.
void PointIrradiance::GatherBrightestFirst(PatchId patch, const ReceiverPoint& at, DimSources dim,
                                           Gathering& gathering) const {
  const Scratch<std::vector<RankedSource>> scratch;
  std::vector<RankedSource>& ranked = *scratch;
  for (const PatchPair& pair : leaves_->SourcesOf(forest_->LeafAt(patch, at.position))) {
    const std::span<const SourceSet::Node> tree = sources_.Tree(pair.source);
    if (tree.empty()) continue;
    const UnhinderedFactor factor = FactorUnhindered(tree[0], pair.source, at);
    const Rgb& radiosity = tree[0].radiosity;
    ranked.push_back({radiosity.maxCoeff() * factor.about, radiosity * factor.most, &pair});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const RankedSource& a, const RankedSource& b) { return a.light > b.light; });
  for (std::size_t i = ranked.size(); i-- > 1;) ranked[i - 1].rest += ranked[i].rest;
  for (const auto& [light, rest, pair] : ranked) {
    if (dim == DimSources::kLeaveOut && gathering.IsNegligible(rest)) return;
    gathering.AddSource(pair->source, leaves_->Blockers(*pair), patch);
  }
}

PointIrradiance::UnhinderedFactor PointIrradiance::FactorUnhindered(const SourceSet::Node& source,
                                                                    PatchId patch,
                                                                    const ReceiverPoint& at) const {
  const Vec3 to = source.centre - at.position;
  const double high = std::max(0.0, at.normal.dot(to) + source.radius);
  const Vec3& normal = scene_.patches[static_cast<std::size_t>(patch)].normal;
  const double deep = std::max(0.0, source.radius - normal.dot(to));
  const auto at_distance = [&](double d) {
    if (d <= 0) return 1.0;
    return std::min(
        1.0, source.area * std::min(1.0, high / d) * std::min(1.0, deep / d) / (std::numbers::pi * d * d));
  };
  const double distance = to.norm();
  return {at_distance(std::max(distance, source.radius)), at_distance(distance - source.radius)};
}

void PointIrradiance::GatherOnPatch(PatchId patch, const ReceiverPoint& at, Gathering& gathering) const {
  if (forest_ != nullptr) {
    for (const PatchPair& pair : leaves_->SourcesOf(forest_->LeafAt(patch, at.position)))
      gathering.AddSource(pair.source, leaves_->Blockers(pair), patch);
  } else {
    for (const PatchPair& pair : visibility_.SourcesOf(patch))
      gathering.AddSource(pair.source, visibility_.Blockers(pair), patch);
  }
}

PointIrradianceResult PointIrradiance::OnPatch(PatchId patch, const ReceiverPoint& given,
                                               IrradianceParts* parts) const {
  const ReceiverPoint at = Nudged(given);
  if (closer_gather_) return Sampled(*closer_gather_, at, parts);
  Gathering gathering(scene_, sources_, at, options_, parts);
  GatherOnPatch(patch, at, gathering);
  return {gathering.irradiance(), gathering.one_sided(), nullptr};
}

PointIrradianceResult PointIrradiance::NearlyOnPatch(PatchId patch, const ReceiverPoint& given,
                                                     double tolerance) const {
  tolerance *= options_.part_of_tolerance;
  const ReceiverPoint at = Nudged(given);
  if (gather_) return Sampled(*gather_, at, nullptr);
  Gathering gathering(scene_, sources_, at, options_, nullptr);
  if (options_.method != nullptr || forest_ == nullptr) {
    GatherOnPatch(patch, at, gathering);
    return {gathering.irradiance(), gathering.one_sided(), nullptr};
  }
  gathering.AllowAggregates(tolerance);
  GatherBrightestFirst(patch, at, DimSources::kLeaveOut, gathering);
  const Rgb light = gathering.irradiance();
  if ((gathering.unhindered() <= kMostlyHidden * light).all()) return {light, gathering.one_sided(), nullptr};
  Gathering closer(scene_, sources_, at, options_, nullptr);
  closer.AllowAggregates(tolerance, light, /*mostly_hidden=*/true);
  GatherBrightestFirst(patch, at, DimSources::kLeaveOut, closer);
  return {closer.irradiance(), closer.one_sided(), nullptr};
}

void PointIrradiance::SampleTogether(std::span<const PatchPoint> points,
                                     std::span<PointIrradianceResult> results) const {
  PENUMBRA_CHECK(IsSampled() && results.size() == points.size());
  std::vector<ReceiverPoint> receivers;
  receivers.reserve(points.size());
  for (const PatchPoint& point : points) receivers.push_back(point.at);
  const std::vector<std::vector<std::size_t>> groups = GroupNeighbours(receivers, FinalGather::kTogether);
  constexpr std::size_t kGroupsATask = 4;
  const auto compute = [&](std::size_t g) {
    std::array<ReceiverPoint, FinalGather::kTogether> at;
    std::array<Rgb, FinalGather::kTogether> irradiance;
    const std::size_t count = groups[g].size();
    for (std::size_t k = 0; k < count; ++k) at[k] = receivers[groups[g][k]];
    const std::span<const ReceiverPoint> together = std::span(at).first(count);
    gather_->AtAll(together, std::span(irradiance).first(count));
    const std::uint32_t one_sided = gather_->AreOneSided(together);
    for (std::size_t k = 0; k < count; ++k)
      results[groups[g][k]] = {irradiance[k], (one_sided >> k & 1) != 0, nullptr};
  };
  const auto transfer = [&](std::size_t g, auto& archive) {
    for (const std::size_t k : groups[g]) Transfer(archive, results[k]);
  };
  DealOut({groups.size(), kGroupsATask, compute, transfer, transfer});
}

PointIrradianceResult PointIrradiance::RecordOnPatch(PatchId patch, const ReceiverPoint& given,
                                                     double tolerance) const {
  if (!CanRecord()) return NearlyOnPatch(patch, given, tolerance);
  const ReceiverPoint at = Nudged(given);
  auto row = std::make_shared<FactorRow>();
  const auto gather = [&](const Rgb& known, bool hidden) {
    *row = {};
    Gathering gathering(scene_, sources_, at, options_, nullptr);
    gathering.AllowAggregates(tolerance * options_.part_of_tolerance, known, hidden);
    gathering.RecordRow(*row);
    GatherBrightestFirst(patch, at, DimSources::kGather, gathering);
    const Rgb light = gathering.irradiance();
    const bool mostly_hidden = (gathering.unhindered() > kMostlyHidden * light).any();
    return std::tuple(light, gathering.one_sided(), mostly_hidden);
  };
  auto [light, one_sided, mostly_hidden] = gather(Rgb::Zero(), false);
  if (mostly_hidden) std::tie(light, one_sided, mostly_hidden) = gather(light, true);
  row->terms.shrink_to_fit();
  return {Irradiance(*row, sources_), one_sided, std::move(row)};
}

// The light of a row for the present sources, without that of sources that must be gathered anew.
PointIrradiance::KnownLight PointIrradiance::LightOf(const FactorRow& row) const {
  KnownLight light;
  for (const FactorRow::Source& source : row.sources) {
    const std::span<const SourceSet::Node> tree = sources_.Tree(source.patch);
    if (tree.empty()) continue;
    light.unhindered += source.unhindered * tree[0].radiosity;
    const bool whole = std::all_of(row.terms.begin() + source.first, row.terms.begin() + source.end,
                                   [](const FactorTerm& term) { return term.node >= 0; });
    if (whole) light.arrives += Irradiance(row, source.first, source.end, sources_);
  }
  light.arrives = light.arrives.max(0.0);
  light.mostly_hidden = (light.unhindered > kMostlyHidden * light.arrives).any();
  return light;
}

// True if the terms of a source may stay in the row.
bool PointIrradiance::Holds(const FactorRow& row, const FactorRow::Source& source, const KnownLight& light,
                            double tolerance) const {
  const double whole = source.unhindered;
  const Rgb unhindered = sources_.Tree(source.patch)[0].radiosity * whole;
  const double of_many = AggregateTolerance(tolerance, row.returned, unhindered, light.arrives);
  const double returned = (1 - row.returned) * (1 - row.returned);
  const double allowed = kHolds * (light.mostly_hidden ? of_many : std::max(returned * tolerance, of_many));
  double error = 0;
  for (std::uint32_t i = source.first; i < source.end; ++i) {
    const FactorTerm& term = row.terms[i];
    if (term.node < 0) return false;
    const SourceSet::NodeLight& node = sources_.LightOf(term.node);
    error += term.factor * (term.by_spread * node.spread + term.by_residual * node.residual);
  }
  return error <= allowed * whole;
}

std::size_t PointIrradiance::Renew(PatchId patch, const ReceiverPoint& given, double tolerance,
                                   std::span<const PatchId> new_sources, FactorRow& row) const {
  tolerance *= options_.part_of_tolerance;
  const KnownLight light = LightOf(row);
  const bool all_hold = std::all_of(row.sources.begin(), row.sources.end(), [&](const FactorRow::Source& s) {
    return !sources_.Tree(s.patch).empty() && Holds(row, s, light, tolerance);
  });
  if (all_hold && new_sources.empty()) return 0;
  std::vector<PatchId> again(new_sources.begin(), new_sources.end());
  FactorRow renewed;
  renewed.returned = row.returned;
  for (const FactorRow::Source& source : row.sources) {
    if (sources_.Tree(source.patch).empty()) continue;
    if (!Holds(row, source, light, tolerance)) {
      again.push_back(source.patch);
      continue;
    }
    const auto first = static_cast<std::uint32_t>(renewed.terms.size());
    renewed.terms.insert(renewed.terms.end(), row.terms.begin() + source.first,
                         row.terms.begin() + source.end);
    renewed.sources.push_back(
        {source.patch, first, static_cast<std::uint32_t>(renewed.terms.size()), source.unhindered});
  }
  const ReceiverPoint at = Nudged(given);
  Gathering gathering(scene_, sources_, at, options_, nullptr);
  gathering.AllowAggregates(tolerance, light.arrives, light.mostly_hidden);
  gathering.RecordRow(renewed);
  std::size_t gathered = 0;
  const std::span<const PatchPair> pairs = leaves_->SourcesOf(forest_->LeafAt(patch, at.position));
  for (const PatchId source : again) {
    const auto pair = std::lower_bound(pairs.begin(), pairs.end(), source,
                                       [](const PatchPair& a, PatchId b) { return a.source < b; });
    if (pair == pairs.end() || pair->source != source) continue;
    gathering.AddSource(source, leaves_->Blockers(*pair), patch);
    ++gathered;
  }
  renewed.terms.shrink_to_fit();
  row = std::move(renewed);
  return gathered;
}

Rgb PointIrradiance::OnPatch(PatchId patch, const ReceiverPoint& given, std::span<double> factors) const {
  PENUMBRA_CHECK(factors.size() == sources_.LeafRadiosities().size());
  std::fill(factors.begin(), factors.end(), 0.0);
  const ReceiverPoint at = Nudged(given);
  Gathering gathering(scene_, sources_, at, options_, nullptr);
  gathering.RecordFactors(factors);
  GatherOnPatch(patch, at, gathering);
  return gathering.irradiance();
}

PointIrradianceResult PointIrradiance::Anywhere(const ReceiverPoint& given, IrradianceParts* parts,
                                                const DividedSources* divided) const {
  const ReceiverPoint at = Nudged(given);
  if (closer_gather_) return Sampled(*closer_gather_, at, parts);
  Gathering gathering(scene_, sources_, at, options_, parts);
  const Scratch<std::vector<PatchId>> found;
  const Scratch<std::vector<Screen>> screens;
  if (source_patches_.size() > kManySources) screens_.Find({&at, 1}, kLeastScreen, kMostScreens, *screens);
  source_patches_.Find({{at.normal, at.normal.dot(at.position)}}, *screens, *found);
  const auto is_divided = [&](PatchId source) {
    return divided && std::binary_search(divided->patches.begin(), divided->patches.end(), source);
  };
  for (const PatchId source : *found)
    if (!is_divided(source)) gathering.AddSource(source, patches_, *screens);
  PointIrradianceResult result{gathering.irradiance(), gathering.one_sided(), nullptr};
  if (!divided) return result;
  Gathering closer(scene_, divided->sources, at, options_, parts);
  for (const PatchId source : *found)
    if (is_divided(source)) closer.AddSource(source, patches_, *screens);
  result.irradiance += closer.irradiance();
  result.one_sided = result.one_sided || closer.one_sided();
  return result;
}

}  // namespace penumbra
