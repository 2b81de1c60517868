#include "solver/transport/points/leaf_irradiance.h"

#include <cmath>

#include "solver/transport/links/cubature.h"

namespace penumbra {
namespace {

// If the samples of a polygon differ by at most kEven times their mean, one rule suffices. Other polygons,
// crossed by shadows or contacts, are split into four, at most kMostRefined times.
constexpr double kEven = 0.25;
constexpr int kMostRefined = 1;

}  // namespace

LeafIrradiance ExactLeafIrradiance(const RadiositySolution& solution, const PointIrradiance& irradiance,
                                   ElementId leaf, LeafSampling sampling, double tolerance) {
  const Element& element = solution.forest[leaf];
  ReceiverPoint at;
  at.normal = solution.forest.scene().patches[element.patch].normal;
  const auto at_point = [&] {
    return (tolerance > 0 ? irradiance.NearlyOnPatch(element.patch, at, tolerance)
                          : irradiance.OnPatch(element.patch, at))
        .irradiance;
  };
  const auto mean_over = [&](std::span<const Vec3> polygon) -> Rgb {
    at.position = Centroid(polygon);
    const Rgb centre = at_point();
    if (sampling == LeafSampling::kCentroid) return centre;
    for (int refinement = 0;; ++refinement) {
      // The centre detects evenly spaced rule points that all fall on the stripes of a blind.
      Rgb lowest = centre, highest = centre;
      Rgb mean = Rgb::Zero();
      for (const CubaturePoint& point : Cubature(polygon, refinement)) {
        at.position = point.position;
        const Rgb value = at_point();
        mean += point.weight * value;
        lowest = lowest.min(value);
        highest = highest.max(value);
      }
      const bool even = (highest - lowest).maxCoeff() <= kEven * mean.maxCoeff();
      if (even || refinement == kMostRefined) return mean;
    }
  };
  LeafIrradiance exact;
  const std::span<const Fragment> fragments = solution.FragmentsOf(leaf);
  if (fragments.empty()) {
    exact.mean = mean_over(element.Vertices());
    return exact;
  }
  double area = 0;
  for (const Fragment& fragment : fragments) {
    exact.fragments.push_back(mean_over(fragment.polygon));
    exact.mean += fragment.area * exact.fragments.back();
    area += fragment.area;
  }
  if (area > 0)
    exact.mean /= area;
  else
    exact.mean = exact.fragments.front();
  return exact;
}

}  // namespace penumbra
