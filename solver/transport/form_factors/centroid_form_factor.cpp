#include "solver/transport/form_factors/centroid_form_factor.h"

#include <cmath>

#include "solver/geometry/polygon.h"
#include "solver/transport/form_factors/pair_form_factor.h"
#include "solver/transport/links/approximate_form_factor.h"

namespace penumbra {
namespace {

FormFactorEstimate BetweenCentroids(const SightedPair& pair) {
  const Vec3 from = Centroid(pair.sender), to = Centroid(pair.target);
  const double area = VectorArea(pair.target).norm();
  const double factor = area * PointKernel(pair, from, to);
  if (factor <= 0 || !InSight(pair, from, to)) return {};
  const double of_disk = DiskFactor(from, pair.SenderNormal(), to, pair.TargetNormal(), area);
  return {factor, std::abs(factor - of_disk)};
}

}  // namespace

LinkFormFactorRegistry::Method CentroidFormFactorMethod() {
  return {"centroids",
          "the kernel between the two centroids, which counts as visible or not",
          {},
          [](const LinkFormFactorOptions& options) {
            return std::make_unique<const PairFormFactor>(BetweenCentroids, 1, false, options);
          }};
}

}  // namespace penumbra
