#include "solver/transport/solution_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/base/parallel.h"
#include "solver/scene/surface_points.h"
#include "solver/transport/leaf_irradiance.h"

namespace penumbra {
namespace {

constexpr std::size_t kPointGrain = 8;

}  // namespace

double EstimateSolutionError(const RadiositySolution& solution, const PointIrradiance& irradiance,
                             std::size_t points, std::uint64_t seed) {
  const Scene& scene = solution.forest.scene();
  if (scene.patches.empty() || points == 0) return 0;
  const std::vector<SurfacePoint> at = SpreadPoints(scene, points, seed);
  std::vector<double> squares(points), means(points);
  ParallelFor(points, kPointGrain, [&](std::size_t i) {
    const ElementId leaf = solution.forest.LeafAt(at[i].patch, at[i].position);
    const Rgb exact = ExactLeafIrradiance(solution, irradiance, leaf, LeafSampling::kCubature).mean;
    const double difference = (exact - solution.irradiance[leaf]).abs().maxCoeff();
    squares[i] = difference * difference;
    means[i] = exact.maxCoeff();
  });
  double square = 0, mean = 0, reflectance = 0;
  for (std::size_t i = 0; i < points; ++i) {
    square += squares[i];
    mean += means[i];
    reflectance += scene.MaterialOf(at[i].patch).reflectance.maxCoeff();
  }
  const auto count = static_cast<double>(points);
  return mean > 0 ? std::sqrt(square / count) / (mean / count) / (1 - reflectance / count) : 0;
}

}  // namespace penumbra
