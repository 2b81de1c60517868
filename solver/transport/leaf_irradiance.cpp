#include "solver/transport/leaf_irradiance.h"

#include "solver/transport/cubature.h"

namespace penumbra {

LeafIrradiance ExactLeafIrradiance(const RadiositySolution& solution, const PointIrradiance& irradiance,
                                   ElementId leaf) {
  const Element& element = solution.forest[leaf];
  ReceiverPoint at;
  at.normal = solution.forest.scene().patches[element.patch].normal;
  const auto mean_over = [&](std::span<const Vec3> polygon) -> Rgb {
    Rgb mean = Rgb::Zero();
    for (const CubaturePoint& point : Cubature(polygon)) {
      at.position = point.position;
      mean += point.weight * irradiance.OnPatch(element.patch, at).irradiance;
    }
    return mean;
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
  exact.mean /= area;
  return exact;
}

}  // namespace penumbra
