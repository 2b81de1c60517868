#include "solver/visibility/pair/screens.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>

#include "solver/base/scratch.h"
#include "solver/geometry/polygon.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {
namespace {

// Only this many patches, the largest, are candidates for screens.
constexpr std::size_t kMostDiscs = 1024;

// Number of patches tested for each requested screen; some lie in the shadows of others.
constexpr std::size_t kLookedAtForEach = 4;

// The shadow of the patch for one point. The first half-space is the one beyond the patch's plane.
ConvexRegion PointShadow(const ReceiverPoint& at, const Patch& patch) {
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

}  // namespace

ConvexRegion ShadowRegion(std::span<const ReceiverPoint> from, const Patch& patch) {
  ConvexRegion all;
  for (const ReceiverPoint& at : from) {
    const ConvexRegion shadow = PointShadow(at, patch);
    if (shadow.empty()) return {};
    if (all.empty()) {
      all = shadow;
    } else if (shadow[0].normal != all[0].normal) {
      return {};
    } else {
      all.insert(all.end(), shadow.begin() + 1, shadow.end());
    }
  }
  return all;
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

void ScreenFinder::Find(std::span<const ReceiverPoint> from, double least, std::size_t count,
                        std::vector<Screen>& screens) const {
  Vec3 eye = Vec3::Zero();
  for (const ReceiverPoint& at : from) eye += at.position / static_cast<double>(from.size());
  const Scratch<std::vector<double>> angles;
  std::vector<double>& angle = *angles;
  const std::size_t size = patch_.size();
  angle.resize(size);
  // The estimate leaves out the cosine: a close wall hides half of the view, although its centre is seen at a
  // grazing angle.
  for (std::size_t i = 0; i < size; ++i) {
    const double x = centre_[0][i] - eye.x(), y = centre_[1][i] - eye.y(), z = centre_[2][i] - eye.z();
    angle[i] = area_[i] / (x * x + y * y + z * z + area_[i] / (2 * std::numbers::pi));
  }
  const Scratch<std::vector<std::pair<double, std::size_t>>> large_ones;
  std::vector<std::pair<double, std::size_t>>& large = *large_ones;
  for (std::size_t i = 0; i < size; ++i)
    if (angle[i] >= least) large.emplace_back(-angle[i], i);
  const std::size_t looked_at = std::min(kLookedAtForEach * count, large.size());
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
    ConvexRegion shadow = ShadowRegion(from, patch);
    if (!shadow.empty()) screens.push_back({id, std::move(shadow)});
  }
}

}  // namespace penumbra
