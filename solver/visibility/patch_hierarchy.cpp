#include "solver/visibility/patch_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "solver/geometry/polygon.h"
#include "solver/visibility/direction_polygon.h"

namespace penumbra {
namespace {

// No more patches than this, the largest of all, are looked at as screens.
constexpr std::size_t kMostDiscs = 1024;

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

bool PatchHierarchy::Hidden(const Node& node, std::span<const Screen> screens) const {
  return std::any_of(screens.begin(), screens.end(), [&](const Screen& screen) {
    return std::all_of(screen.shadow.begin(), screen.shadow.end(), [&](const HalfSpace& space) {
      return Reach(space, node.centre, node.half, -1) > margin_;
    });
  });
}

void PatchHierarchy::Find(const ConvexRegion& region, std::span<const Screen> screens,
                          std::vector<PatchId>& found) const {
  found.clear();
  for (std::size_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    bool out = false;
    for (std::size_t k = 0; k < region.size() && !out; ++k)
      out = Reach(region[k], node.centre, node.half, 1) < -margin_;
    if (out || Hidden(node, screens)) {
      i += static_cast<std::size_t>(node.skip);
      continue;
    }
    if (node.count == 1) found.push_back(order_[static_cast<std::size_t>(node.first)]);
    ++i;
  }
  std::sort(found.begin(), found.end());
}

ScreenFinder::ScreenFinder(const Scene& scene) : scene_(&scene) {
  std::vector<PatchId> order(scene.patches.size());
  std::iota(order.begin(), order.end(), 0);
  const std::size_t count = std::min(order.size(), kMostDiscs);
  const auto area = [&](PatchId p) { return scene.patches[static_cast<std::size_t>(p)].area; };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](PatchId a, PatchId b) { return area(a) != area(b) ? area(a) > area(b) : a < b; });
  for (std::size_t i = 0; i < count; ++i) {
    const Patch& patch = scene.patches[static_cast<std::size_t>(order[i])];
    const Vec3 centre = Centroid(patch.Vertices());
    patch_.push_back(order[i]);
    for (int axis = 0; axis < 3; ++axis) centre_[axis].push_back(centre[axis]);
    area_.push_back(patch.area);
  }
}

void ScreenFinder::Find(const ReceiverPoint& at, double least, std::size_t count,
                        std::vector<Screen>& screens) const {
  thread_local std::vector<double> angle;
  const std::size_t size = patch_.size();
  angle.resize(size);
  // Not the cosine: a wall close by, seen at a flat angle from its middle, hides half of the world.
  for (std::size_t i = 0; i < size; ++i) {
    const double x = centre_[0][i] - at.position.x(), y = centre_[1][i] - at.position.y(),
                 z = centre_[2][i] - at.position.z();
    angle[i] = area_[i] / (x * x + y * y + z * z + area_[i] / (2 * std::numbers::pi));
  }
  thread_local std::vector<std::pair<double, std::size_t>> large;
  large.clear();
  for (std::size_t i = 0; i < size; ++i)
    if (angle[i] >= least) large.emplace_back(-angle[i], i);
  const std::size_t looked_at = std::min(4 * count, large.size());
  std::partial_sort(large.begin(), large.begin() + static_cast<std::ptrdiff_t>(looked_at), large.end());
  screens.clear();
  for (std::size_t k = 0; k < looked_at && screens.size() < count; ++k) {
    const PatchId id = patch_[large[k].second];
    const Patch& patch = scene_->patches[static_cast<std::size_t>(id)];
    const bool hidden = std::any_of(screens.begin(), screens.end(), [&](const Screen& screen) {
      return std::all_of(screen.shadow.begin(), screen.shadow.end(), [&](const HalfSpace& space) {
        return std::all_of(patch.Vertices().begin(), patch.Vertices().end(),
                           [&](const Vec3& v) { return space.normal.dot(v) > space.offset; });
      });
    });
    if (hidden) continue;
    ConvexRegion shadow = ShadowRegion(at, patch);
    if (!shadow.empty()) screens.push_back({id, std::move(shadow)});
  }
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
