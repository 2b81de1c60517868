// solver/visibility/point/sampled_visibility.h

#pragma once

#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {

// Occlusion by sampling: the method that chapter 6 of the thesis considers first and rejects. The source is
// divided into the cells of a regular grid, and a cell counts as visible if its centre is visible. Occlusion
// by sampling is not exact: the relative error is about the fraction of the source in cells that shadow
// borders cross. As a function of the receiver point, the sampled form factor jumps.
class SampledVisibility final : public OcclusionMethod {
 public:
  // Each quadrilateral or triangle of the source is divided into divisions^2 cells.
  explicit SampledVisibility(int divisions = 16) : divisions_(divisions) {}

  double VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                           const Vec3& normal) const override;

 private:
  int divisions_;
};

OcclusionRegistry::Method SampledVisibilityMethod();

}  // namespace penumbra
