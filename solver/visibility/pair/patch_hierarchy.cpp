#include "solver/visibility/pair/patch_hierarchy.h"

#include <algorithm>
#include <utility>

#include "solver/geometry/polygon.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {
namespace {

// The height of the highest (sign 1) or lowest (sign -1) point of a box above the border of the half-space.
double Reach(const HalfSpace& space, const Vec3& centre, const Vec3& half, double sign) {
  return space.normal.dot(centre) - space.offset + sign * space.normal.cwiseAbs().dot(half);
}

// Error of the test of a box against a half-space, in roundings of a height: those of the box's centre and
// size, of the plane, and of the distance between them.
constexpr double kMarginRoundings = 4;

}  // namespace

PatchHierarchy::PatchHierarchy(const Scene& scene, std::vector<PatchId> patches)
    : order_(std::move(patches)) {
  if (order_.empty()) return;
  nodes_.reserve(2 * order_.size());
  Build(scene, 0, order_.size());
  margin_ = kMarginRoundings * HeightRounding(MaxAbs(nodes_[0].centre) + MaxAbs(nodes_[0].half));
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

}  // namespace penumbra
