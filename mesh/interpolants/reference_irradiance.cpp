#include "mesh/interpolants/reference_irradiance.h"

#include <algorithm>
#include <limits>

#include "solver/transport/sources/error_floors.h"

namespace penumbra {

ReferenceIrradiance::ReferenceIrradiance(const RadiositySolution& solution, DiscontinuityWeight weight)
    : solution_(solution),
      darkest_(solution.forest.scene().patches.size(), std::numeric_limits<double>::infinity()) {
  if (weight == DiscontinuityWeight::kThesis) return;
  double area = 0;
  for (std::size_t i = 0; i < solution.irradiance.size(); ++i) {
    const Element& element = solution.forest.elements()[i];
    if (!element.IsLeaf()) continue;
    const double light = solution.irradiance[i].maxCoeff();
    double& darkest = darkest_[static_cast<std::size_t>(element.patch)];
    darkest = std::min(darkest, light);
    mean_ += element.area * light;
    area += element.area;
  }
  if (area > 0) mean_ /= area;
}

double ReferenceIrradiance::ScaleOf(const ElementForest& forest, ElementId leaf) const {
  if (mean_ == 0) return 1;
  while (static_cast<std::size_t>(leaf) >= solution_.irradiance.size()) leaf = forest[leaf].parent;
  return Scale(solution_.irradiance[static_cast<std::size_t>(leaf)].maxCoeff(), kLeafFloor);
}

double ReferenceIrradiance::ScaleIn(const Rgb& light) const { return Scale(light.maxCoeff(), kErrorFloor); }

double ReferenceIrradiance::LargestScale(PatchId patch) const {
  return Scale(darkest_[static_cast<std::size_t>(patch)], kLeafFloor);
}

DiscontinuityOptions ReferenceIrradiance::ToFindOn(PatchId patch, DiscontinuityOptions options) const {
  options.min_weight = options.LeastWeight() / LargestScale(patch);
  return options;
}

double ReferenceIrradiance::Scale(double light, double darkest) const {
  return mean_ > 0 ? mean_ / std::max(light, darkest * mean_) : 1;
}

}  // namespace penumbra
