#include "solver/transport/solution_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/base/parallel.h"
#include "solver/scene/surface_points.h"

namespace penumbra {
namespace {

constexpr std::size_t kPointGrain = 16;

}  // namespace

double EstimateSolutionError(const RadiositySolution& solution, const PointIrradiance& irradiance,
                             std::size_t points, std::uint64_t seed) {
  const Scene& scene = solution.forest.scene();
  if (scene.patches.empty() || points == 0) return 0;
  const std::vector<SurfacePoint> at = SpreadPoints(scene, points, seed);
  std::vector<Rgb> exact(points), difference(points);
  ParallelFor(points, kPointGrain, [&](std::size_t i) {
    ReceiverPoint receiver;
    receiver.position = at[i].position;
    receiver.normal = scene.patches[at[i].patch].normal;
    exact[i] = irradiance.OnPatch(at[i].patch, receiver).irradiance;
    difference[i] = exact[i] - solution.irradiance[solution.forest.LeafAt(at[i].patch, at[i].position)];
  });

  double missing = 0, reflected = 0, reflectance = 0;
  for (std::size_t i = 0; i < points;) {
    const PatchId patch = at[i].patch;
    const Rgb& rho = scene.MaterialOf(patch).reflectance;
    Rgb sum = Rgb::Zero();
    for (; i < points && at[i].patch == patch; ++i) {
      sum += difference[i];
      reflected += (rho * exact[i]).maxCoeff();
      reflectance += rho.maxCoeff();
    }
    missing += (rho * sum).abs().maxCoeff();
  }
  const double mean_reflectance = reflectance / static_cast<double>(points);
  return reflected > 0 ? missing / reflected / (1 - mean_reflectance) : 0;
}

}  // namespace penumbra
