#include "solver/transport/form_factors/pair_form_factor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/base/parallel.h"
#include "solver/transport/links/link_cubature.h"
#include "solver/visibility/pair/tube_blockers.h"

namespace penumbra {
namespace {

// The number of a pair, for seeds; element and part numbers have 32 bits.
std::uint64_t PlaceOf(std::size_t sender, std::size_t target) {
  return (static_cast<std::uint64_t>(sender) << 31U) ^ static_cast<std::uint64_t>(target);
}

// Seeds of all pairs of a sender differ from those of single pairs.
constexpr std::uint64_t kSenderSeed = 0x5851f42d4c957f2dULL;

PatchHierarchy AllPatchesOf(const Scene& scene) {
  std::vector<PatchId> all(scene.patches.size());
  std::iota(all.begin(), all.end(), 0);
  return PatchHierarchy(scene, std::move(all));
}

}  // namespace

bool InSight(const SightedPair& pair, const Vec3& from, const Vec3& to) {
  return std::none_of(pair.blockers.begin(), pair.blockers.end(), [&](PatchId b) {
    if (b == pair.sender_patch || b == pair.target_patch) return false;
    const Patch& patch = pair.scene.patches[static_cast<std::size_t>(b)];
    const double start = patch.normal.dot(from - patch.vertex[0]),
                 end = patch.normal.dot(to - patch.vertex[0]);
    if ((start > 0) == (end > 0)) return false;
    return ConvexContains(patch.Vertices(), patch.normal, from + (to - from) * (start / (start - end)), 0);
  });
}

Vec3 UniformPoint(std::span<const Vec3> polygon, double s, double t) {
  const Vec3& apex = polygon[0];
  double whole = 0;
  const auto area = [&](std::size_t i) { return (polygon[i - 1] - apex).cross(polygon[i] - apex).norm(); };
  for (std::size_t i = 2; i < polygon.size(); ++i) whole += area(i);
  // The triangle of the fan whose share of the area contains s; what s has left of the share is uniform
  // again.
  double rest = s * whole;
  std::size_t i = 2;
  for (; i + 1 < polygon.size() && rest >= area(i); ++i) rest -= area(i);
  const double own = area(i), u = own > 0 ? std::min(1.0, rest / own) : 0, root = std::sqrt(u);
  return apex + root * ((1 - t) * (polygon[i - 1] - apex) + t * (polygon[i] - apex));
}

double PointKernel(const SightedPair& pair, const Vec3& at_sender, const Vec3& at_target) {
  const Vec3 way = at_target - at_sender;
  const double here = pair.SenderNormal().dot(way), there = -pair.TargetNormal().dot(way);
  if (here <= 0 || there <= 0) return 0;
  const double square = way.squaredNorm();
  return here * there / (std::numbers::pi * square * square);
}

void SampleMean::Add(double value, double most) {
  sum_ += value;
  squares_ += value * value;
  largest_ = std::max(largest_, most);
  ++count_;
}

FormFactorEstimate SampleMean::Estimate() const {
  FormFactorEstimate estimate;
  if (count_ == 0) return estimate;
  const auto n = static_cast<double>(count_);
  estimate.factor = sum_ / n;
  const double spread = std::max(0.0, squares_ / n - estimate.factor * estimate.factor);
  estimate.error = std::sqrt(spread / n + largest_ * largest_ / (n * n));
  estimate.points = count_;
  return estimate;
}

PairFormFactor::PairFormFactor(PairRule rule, std::size_t link_rays, bool sampled,
                               const LinkFormFactorOptions& options)
    : rule_(std::move(rule)),
      rays_(options.rays > 0 ? options.rays : link_rays),
      sampled_(sampled),
      seed_(options.seed),
      factors_only_(options.factors_only) {}

void PairFormFactor::Find(ReceiverLinks* links, const ExecutionContext& context) const {
  if (!factors_only_) FindByCubature(links, context);
  const ElementForest& forest = links->forest;
  const Element& receiver = forest[links->receiver];
  const auto place = static_cast<std::size_t>(links->receiver);
  for (std::size_t i = 0; i < links->views.size(); ++i) {
    if (context.Cancelled()) return;
    Link& link = links->set.links[i];
    const Element& source = forest[link.source];
    link.form_factor =
        rule_({forest.scene(), receiver.patch, source.patch, receiver.Vertices(), source.Vertices(),
               links->views[i].blockers, rays_, Random(seed_ ^ kSenderSeed, place),
               Random(seed_, PlaceOf(place, static_cast<std::size_t>(link.source)))})
            .factor;
  }
}

std::optional<FormFactorEstimate> PairFormFactor::Between(const Scene& scene, std::span<const AreaPart> from,
                                                          std::span<const AreaPart> to,
                                                          const ExecutionContext& context) const {
  const PatchHierarchy all = AllPatchesOf(scene);
  std::vector<double> area;
  for (const AreaPart& part : from) area.push_back(VectorArea(part.polygon).norm());
  const double whole = std::accumulate(area.begin(), area.end(), 0.0);
  std::vector<FormFactorEstimate> pairs(from.size() * to.size());
  ParallelFor(pairs.size(), 1, [&](std::size_t k) {
    const std::size_t i = k / to.size(), j = k % to.size();
    const AreaPart &sender = from[i], &target = to[j];
    if (sender.patch == target.patch || context.Cancelled()) return;
    const Patch &a = scene.patches[static_cast<std::size_t>(sender.patch)],
                &b = scene.patches[static_cast<std::size_t>(target.patch)];
    const std::optional<TubeEnds> ends = ClipToEachOther(sender.polygon, a, target.polygon, b);
    std::vector<PatchId> blockers;
    if (!ends || !FindTubeBlockers(scene, *ends, sender.patch, target.patch, all, blockers)) return;
    const double rays = std::ceil(static_cast<double>(rays_) * area[i] / whole);
    pairs[k] = rule_({scene, sender.patch, target.patch, sender.polygon, target.polygon, blockers,
                      static_cast<std::size_t>(std::max(1.0, rays)), Random(seed_ ^ kSenderSeed, i),
                      Random(seed_, PlaceOf(i, j))});
  });
  FormFactorEstimate sum;
  double squares = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double share = area[k / to.size()] / whole, error = share * pairs[k].error;
    sum.factor += share * pairs[k].factor;
    sum.error += error;
    squares += error * error;
    sum.points += pairs[k].points;
  }
  if (sampled_) sum.error = std::sqrt(squares);
  return sum;
}

}  // namespace penumbra
