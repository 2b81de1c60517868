#include "solver/visibility/patch_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "solver/geometry/polygon.h"
#include "solver/visibility/direction_polygon.h"

namespace penumbra {
namespace {

// By how much the highest (sign 1) or lowest (sign -1) point of a box lies in the half-space.
double Reach(const HalfSpace& space, const Vec3& centre, const Vec3& half, double sign) {
  return space.normal.dot(centre) - space.offset + sign * space.normal.cwiseAbs().dot(half);
}

}  // namespace

PatchHierarchy::PatchHierarchy(const Scene& scene, std::vector<PatchId> patches)
    : order_(std::move(patches)) {
  if (order_.empty()) return;
  nodes_.reserve(2 * order_.size());
  Build(scene, 0, order_.size());
  for (const PatchId p : order_) {
    const Patch& patch = scene.patches[static_cast<std::size_t>(p)];
    disc_.push_back({Centroid(patch.Vertices()), patch.area * patch.normal});
  }
  margin_ = 4 * HeightRounding(MaxAbs(nodes_[0].centre) + MaxAbs(nodes_[0].half));
}

void PatchHierarchy::Build(const Scene& scene, std::size_t first, std::size_t last) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = first; i < last; ++i)
    for (const Vec3& v : scene.patches[static_cast<std::size_t>(order_[i])].Vertices()) box.extend(v);
  const std::size_t at = nodes_.size();
  nodes_.push_back({box.center(), 0.5 * box.sizes(), 1, static_cast<std::int32_t>(first),
                    static_cast<std::int32_t>(last - first)});
  if (last - first == 1) return;
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto middle = [&](PatchId p) {
    const Patch& patch = scene.patches[static_cast<std::size_t>(p)];
    return std::make_pair(Centroid(patch.Vertices())[axis], p);
  };
  const std::size_t half = first + (last - first) / 2;
  const auto begin = order_.begin();
  std::nth_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(half),
                   begin + static_cast<std::ptrdiff_t>(last),
                   [&](PatchId a, PatchId b) { return middle(a) < middle(b); });
  Build(scene, first, half);
  Build(scene, half, last);
  nodes_[at].skip = static_cast<std::int32_t>(nodes_.size() - at);
}

void PatchHierarchy::Find(const ConvexRegion& region, std::span<const ConvexRegion> shadows,
                          std::vector<PatchId>& found) const {
  found.clear();
  for (std::size_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    bool out = false;
    for (std::size_t k = 0; k < region.size() && !out; ++k)
      out = Reach(region[k], node.centre, node.half, 1) < -margin_;
    for (std::size_t s = 0; s < shadows.size() && !out; ++s)
      out = std::all_of(shadows[s].begin(), shadows[s].end(), [&](const HalfSpace& space) {
        return Reach(space, node.centre, node.half, -1) > margin_;
      });
    if (out) {
      i += static_cast<std::size_t>(node.skip);
      continue;
    }
    if (node.count == 1) found.push_back(order_[static_cast<std::size_t>(node.first)]);
    ++i;
  }
  std::sort(found.begin(), found.end());
}

void PatchHierarchy::FindLargest(const Vec3& eye, double least, std::size_t count,
                                 std::vector<PatchId>& found) const {
  std::vector<std::pair<double, PatchId>> large;
  for (std::size_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    const double radius = node.half.norm();
    const double distance = std::max(0.0, (node.centre - eye).norm() - radius);
    if (std::numbers::pi * radius * radius < least * distance * distance) {
      i += static_cast<std::size_t>(node.skip);
      continue;
    }
    if (node.count == 1) {
      const auto p = static_cast<std::size_t>(node.first);
      const Vec3 sight = disc_[p].centre - eye;
      const double square = std::max(sight.squaredNorm(), disc_[p].area.norm() / (2 * std::numbers::pi));
      const double angle = std::abs(disc_[p].area.dot(sight)) / (square * std::sqrt(square));
      if (angle >= least) large.emplace_back(-angle, order_[p]);
    }
    ++i;
  }
  std::sort(large.begin(), large.end());
  found.clear();
  for (std::size_t i = 0; i < std::min(count, large.size()); ++i) found.push_back(large[i].second);
}

ConvexRegion ShadowRegion(const ReceiverPoint& at, const Patch& patch) {
  ConvexRegion shadow;
  const Side side = SideOf(at, patch.normal, patch.vertex[0], patch.extent);
  if (side != Side::kFront && side != Side::kBack) return shadow;
  const bool from_front = side == Side::kFront;
  const Cone cone = MakeCone(at, Seen(at, patch.Vertices(), from_front), patch.extent);
  if (cone.size == 0) return shadow;
  const Vec3 beyond = from_front ? Vec3(-patch.normal) : patch.normal;
  shadow.push_back({beyond, beyond.dot(patch.vertex[0])});
  for (int k = 0; k < cone.size; ++k) {
    const Vec3& normal = cone.normal[static_cast<std::size_t>(k)];
    shadow.push_back({normal, normal.dot(at.position)});
  }
  return shadow;
}

}  // namespace penumbra
