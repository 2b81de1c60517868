#include "solver/scene/surface_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "solver/base/check.h"
#include "solver/base/random.h"
#include "solver/geometry/polygon.h"

namespace penumbra {

Vec3 PointOn(std::span<const Vec3> polygon, double s, double t) {
  PENUMBRA_CHECK(polygon.size() >= 3);
  const Vec3 &a = polygon[0], &last = polygon.back();
  if (polygon.size() > 4) {  // the last triangle of the fan, or the rest
    const std::array<Vec3, 3> triangle = {a, polygon[polygon.size() - 2], last};
    const double rest = 1 - VectorArea(triangle).norm() / VectorArea(polygon).norm();
    if (s < rest) return PointOn(polygon.first(polygon.size() - 1), s / rest, t);
    return PointOn(triangle, (s - rest) / (1 - rest), t);
  }
  const double first = (polygon[1] - a).cross(polygon[2] - a).norm();
  const double second = (polygon[2] - a).cross(last - a).norm();
  const double share = first / (first + second);
  const bool in_first = s < share || second == 0;
  const double u = in_first ? s / share : (s - share) / (1 - share);
  const double root = std::sqrt(u);
  return (1 - root) * a + root * ((1 - t) * polygon[in_first ? 1 : 2] + t * (in_first ? polygon[2] : last));
}

std::vector<SurfacePoint> SpreadPoints(const Scene& scene, std::size_t count, std::uint64_t seed) {
  std::vector<double> areas;
  for (const Patch& patch : scene.patches) areas.push_back(patch.area);
  return SpreadPoints(scene, areas, count, seed);
}

std::vector<SurfacePoint> SpreadPoints(const Scene& scene, std::span<const double> weights, std::size_t count,
                                       std::uint64_t seed) {
  std::vector<PatchId> all(scene.patches.size());
  std::iota(all.begin(), all.end(), 0);
  return SpreadPoints(scene, all, weights, count, seed);
}

std::vector<SurfacePoint> SpreadPoints(const Scene& scene, std::span<const PatchId> patches,
                                       std::span<const double> weights, std::size_t count,
                                       std::uint64_t seed) {
  PENUMBRA_CHECK(!patches.empty() && weights.size() == patches.size());
  std::vector<double> up_to;
  double total = 0;
  for (const double weight : weights) up_to.push_back(total += weight);
  Random random(seed);
  std::vector<SurfacePoint> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(i) + random.Uniform()) / static_cast<double>(count) * total;
    const auto found = std::upper_bound(up_to.begin(), up_to.end(), at);
    // Rounding may put `at` at the total itself: that is of the last patch which weighs anything.
    const PatchId p = patches[static_cast<std::size_t>(
        (found == up_to.end() ? std::lower_bound(up_to.begin(), up_to.end(), total) : found) -
        up_to.begin())];
    const double s = random.Uniform(), t = random.Uniform();
    points.push_back({p, PointOn(scene.patches[static_cast<std::size_t>(p)].Vertices(), s, t)});
  }
  return points;
}

}  // namespace penumbra
