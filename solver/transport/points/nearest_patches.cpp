#include "solver/transport/points/nearest_patches.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "solver/geometry/polygon.h"
#include "solver/geometry/polygon_distance.h"

namespace penumbra {

NearestPatches::NearestPatches(const Scene& scene, std::span<const Vec3> polygon,
                               std::span<const PatchPair> seen)
    : scene_(&scene) {
  const Vec3 centre = Centroid(polygon);
  const double size = Diameter(polygon);
  std::vector<std::pair<double, PatchId>> by_distance;
  double nearest = std::numeric_limits<double>::infinity();
  for (const PatchPair& pair : seen) {
    by_distance.emplace_back(DistanceTo(pair.source, centre), pair.source);
    nearest = std::min(nearest, by_distance.back().first);
  }
  // No point of the polygon is farther than `size` from the centre, so distances differ by at most `size`.
  for (const auto& [distance, patch] : by_distance)
    if (distance <= nearest + 2 * size) patches_.push_back(patch);
}

double NearestPatches::DistanceTo(PatchId patch, const Vec3& point) const {
  const Patch& other = scene_->patches[static_cast<std::size_t>(patch)];
  return DistanceToPolygon(other.Vertices(), other.normal, point);
}

double NearestPatches::Distance(const Vec3& point) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const PatchId patch : patches_) nearest = std::min(nearest, DistanceTo(patch, point));
  return nearest;
}

}  // namespace penumbra
