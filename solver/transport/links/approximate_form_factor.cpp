#include "solver/transport/links/approximate_form_factor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

#include "solver/base/parallel.h"
#include "solver/scene/surface_points.h"
#include "solver/transport/links/cubature.h"
#include "solver/visibility/pair/tube_blockers.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {
namespace {

double Area(const AreaPart& part) { return VectorArea(part.polygon).norm(); }

std::vector<PatchId> AllPatches(const Scene& scene) {
  std::vector<PatchId> all(scene.patches.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// A coarse and a fine value of the same flux, as a fraction of the flux that leaves.
struct Pair {
  double coarse = 0, fine = 0;
};

// Computes factor(from, to) for all pairs, as fractions of the flux that leaves `from`.
template <class PairFactor>
std::vector<Pair> AllPairs(std::span<const AreaPart> from, std::span<const AreaPart> to,
                           const ExecutionContext& context, const PairFactor& factor) {
  std::vector<Pair> pairs(from.size() * to.size());
  ParallelFor(pairs.size(), 1, [&](std::size_t k) {
    const AreaPart &sender = from[k / to.size()], &target = to[k % to.size()];
    if (sender.patch != target.patch && !context.Cancelled()) pairs[k] = factor(sender, target);
  });
  return pairs;
}

Pair Mean(std::span<const AreaPart> from, std::size_t targets, std::span<const Pair> pairs) {
  double area = 0;
  Pair sum;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double weight = Area(from[i]);
    area += weight;
    for (std::size_t j = 0; j < targets; ++j) {
      sum.coarse += weight * pairs[i * targets + j].coarse;
      sum.fine += weight * pairs[i * targets + j].fine;
    }
  }
  if (area == 0) return {};
  return {sum.coarse / area, sum.fine / area};
}

// True if no blocker cuts the segment.
bool Free(const Scene& scene, std::span<const PatchId> blockers, const Vec3& from, const Vec3& to) {
  return std::none_of(blockers.begin(), blockers.end(), [&](PatchId b) {
    const Patch& patch = scene.patches[static_cast<std::size_t>(b)];
    const double start = patch.normal.dot(from - patch.vertex[0]),
                 end = patch.normal.dot(to - patch.vertex[0]);
    if ((start > 0) == (end > 0)) return false;
    return ConvexContains(patch.Vertices(), patch.normal, from + (to - from) * (start / (start - end)), 0);
  });
}

struct PlacedArea {
  Vec3 centre;
  double area;
};

double Disk(const Scene& scene, std::span<const PatchId> blockers, const PlacedArea& from,
            const Vec3& from_normal, const PlacedArea& to, const Vec3& to_normal) {
  const double factor = DiskFactor(from.centre, from_normal, to.centre, to_normal, to.area);
  return factor > 0 && Free(scene, blockers, from.centre, to.centre) ? factor : 0;
}

// Cuts a convex polygon into four by two lines through its centroid, parallel and perpendicular to the first
// edge.
std::vector<PlacedArea> Quarters(const Polygon3& polygon, const Vec3& normal) {
  const Vec3 centre = Centroid(polygon), across = polygon[1] - polygon[0], along = normal.cross(across);
  std::vector<PlacedArea> pieces;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) {
      const Polygon3 half = ClipToHalfSpace(polygon, a * across, centre);
      const Polygon3 part = half.empty() ? half : ClipToHalfSpace(half, b * along, centre);
      if (!part.empty()) pieces.push_back({Centroid(part), VectorArea(part).norm()});
    }
  return pieces;
}

double PointFactor(const Scene& scene, const ReceiverPoint& at, PatchId own, const AreaPart& to,
                   std::span<const PatchId> blockers) {
  PointView view(scene, at);
  if (!view.FaceSource(to.patch)) return 0;
  const DirectionPolygon seen = view.SeeSource(to.polygon);
  std::vector<Occluder>& occluders = view.occluder_stack();
  if (seen.empty() || !view.FindBlockers(blockers, own, seen, occluders)) return 0;
  return view.VisibleFormFactor(seen, occluders);
}

// The patches that may stand between the parts; nothing if the parts do not see each other.
std::optional<std::vector<PatchId>> Blockers(const Scene& scene, std::span<const PatchId> all,
                                             const AreaPart& from, const AreaPart& to) {
  const Patch &sender = scene.patches[static_cast<std::size_t>(from.patch)],
              &target = scene.patches[static_cast<std::size_t>(to.patch)];
  const std::optional<TubeEnds> ends = ClipToEachOther(from.polygon, sender, to.polygon, target);
  std::vector<PatchId> blockers;
  if (!ends || !FindTubeBlockers(scene, *ends, from.patch, to.patch, all, blockers)) return std::nullopt;
  return blockers;
}

}  // namespace

double DiskFactor(const Vec3& at, const Vec3& at_normal, const Vec3& centre, const Vec3& normal,
                  double area) {
  const Vec3 way = centre - at;
  const double square = way.squaredNorm();
  const double cosines = std::max(0.0, at_normal.dot(way)) * std::max(0.0, -normal.dot(way));
  return cosines == 0 ? 0 : cosines / square * area / (std::numbers::pi * square + area);
}

FormFactorEstimate DiskFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                  std::span<const AreaPart> to, const ExecutionContext& context) {
  const std::vector<PatchId> all = AllPatches(scene);
  const auto factor = [&](const AreaPart& sender, const AreaPart& target) -> Pair {
    const auto blockers = Blockers(scene, all, sender, target);
    if (!blockers) return {};
    const Vec3 &n = scene.patches[static_cast<std::size_t>(sender.patch)].normal,
               &m = scene.patches[static_cast<std::size_t>(target.patch)].normal;
    Pair pair;
    pair.coarse = Disk(scene, *blockers, {Centroid(sender.polygon), Area(sender)}, n,
                       {Centroid(target.polygon), Area(target)}, m);
    const std::vector<PlacedArea> targets = Quarters(target.polygon, m);
    for (const PlacedArea& a : Quarters(sender.polygon, n))
      for (const PlacedArea& b : targets)
        pair.fine += a.area / Area(sender) * Disk(scene, *blockers, a, n, b, m);
    return pair;
  };
  const Pair mean = Mean(from, to.size(), AllPairs(from, to, context, factor));
  return {mean.coarse, std::abs(mean.fine - mean.coarse)};
}

FormFactorEstimate CubatureFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                      std::span<const AreaPart> to, const ExecutionContext& context) {
  const std::vector<PatchId> all = AllPatches(scene);
  const auto factor = [&](const AreaPart& sender, const AreaPart& target) -> Pair {
    const auto blockers = Blockers(scene, all, sender, target);
    if (!blockers) return {};
    const auto mean = [&](int refinement) {
      double sum = 0;
      for (const CubaturePoint& point : Cubature(sender.polygon, refinement)) {
        ReceiverPoint at;
        at.position = point.position;
        at.normal = scene.patches[static_cast<std::size_t>(sender.patch)].normal;
        sum += point.weight * PointFactor(scene, at, sender.patch, target, *blockers);
      }
      return sum;
    };
    return {mean(1), mean(2)};
  };
  const Pair mean = Mean(from, to.size(), AllPairs(from, to, context, factor));
  return {mean.fine, std::abs(mean.fine - mean.coarse)};
}

}  // namespace penumbra
