#include "experiments/reference/reference_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "solver/base/check.h"
#include "solver/scene/surface_points.h"

namespace penumbra {
namespace {

double DistanceTo(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& p) {
  const double height = normal.dot(p - polygon[0]);
  const Vec3 foot = p - height * normal;
  if (ConvexContains(polygon, normal, foot, 0)) return std::abs(height);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], edge = polygon[(i + 1) % polygon.size()] - a;
    const double t = std::clamp(edge.dot(p - a) / edge.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (a + t * edge - p).norm());
  }
  return least;
}

bool IsClear(const Scene& scene, const SurfacePoint& point, double clearance) {
  const Patch& own = scene.patches[static_cast<std::size_t>(point.patch)];
  for (const Patch& patch : scene.patches) {
    const bool same_plane = std::all_of(patch.Vertices().begin(), patch.Vertices().end(), [&](const Vec3& v) {
      return std::abs(own.normal.dot(v - point.position)) <= 1e-9 * (own.extent + patch.extent);
    });
    if (same_plane && patch.normal.dot(own.normal) > 0) continue;
    if (DistanceTo(patch.Vertices(), patch.normal, point.position) < clearance) return false;
  }
  return true;
}

}  // namespace

std::vector<IrradiancePoint> ReferencePoints(const Scene& scene, std::size_t count, std::uint64_t seed) {
  if (count > 0 && scene.patches.empty()) throw InputError(scene.name + ":0: error: the scene has no faces");
  const double clearance = kClearance * scene.Diagonal();
  // Rounds of drawing a point in each share; then anywhere, for shares that are covered wholly.
  constexpr std::uint64_t kRounds = 50, kMoreRounds = 100'000;
  std::vector<IrradiancePoint> points(count);
  std::vector<char> found(count, 0);
  const auto take = [&](std::size_t i, const SurfacePoint& point) {
    if (found[i] || !IsClear(scene, point, clearance)) return;
    points[i] = {point.position, scene.patches[static_cast<std::size_t>(point.patch)].normal};
    found[i] = 1;
  };
  for (std::uint64_t round = 0; round < kRounds; ++round) {
    if (std::find(found.begin(), found.end(), 0) == found.end()) return points;
    const std::vector<SurfacePoint> drawn = SpreadPoints(scene, count, seed + (round << 32));
    for (std::size_t i = 0; i < count; ++i) take(i, drawn[i]);
  }
  std::uint64_t round = kRounds;
  for (std::size_t i = 0; i < count; ++i)
    for (; !found[i]; ++round) {
      if (round == kMoreRounds)
        throw InputError(scene.name + ":0: error: no place on its fronts is clear of other faces");
      take(i, SpreadPoints(scene, 1, seed + (round << 32))[0]);
    }
  return points;
}

}  // namespace penumbra
