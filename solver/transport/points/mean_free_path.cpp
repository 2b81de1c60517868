#include "solver/transport/points/mean_free_path.h"

#include <vector>

#include "solver/base/parallel.h"
#include "solver/scene/surface_points.h"
#include "solver/scene/tolerances.h"
#include "solver/transport/points/diffuse_rays.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {

double MeanFreePath(const Scene& scene) {
  constexpr std::size_t kRays = 4096, kFewest = kRays / 10;
  constexpr std::uint64_t kSeed = 1;
  if (scene.patches.empty()) return 0;
  const RayCaster caster(scene);
  const double lift = ContactGap(scene);
  const std::vector<SurfacePoint> from = SpreadPoints(scene, kRays, kSeed);
  std::vector<double> length(kRays, 0.0);
  constexpr std::size_t kRaysATask = 256;
  ParallelFor(kRays, kRaysATask, [&](std::size_t i) {
    const Patch& patch = scene.patches[static_cast<std::size_t>(from[i].patch)];
    const DiffuseRay ray = MakeDiffuseRay(patch.Vertices(), patch.normal, lift, i, kSeed);
    const RayCaster::Hit hit = caster.Cast(ray.origin, ray.direction, from[i].patch);
    if (hit.patch != kNoPatch && hit.front) length[i] = hit.distance;
  });
  double sum = 0;
  std::size_t hits = 0;
  for (const double l : length) {
    sum += l;
    hits += l > 0 ? 1 : 0;
  }
  if (hits >= kFewest) return sum / static_cast<double>(hits);
  const auto [low, high] = scene.Bounds();
  return (high - low).norm();
}

}  // namespace penumbra
