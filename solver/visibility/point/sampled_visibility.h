// solver/visibility/point/sampled_visibility.h

#pragma once

#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {

// The first method of the thesis, which the thesis rejects (chapter 6). The source is divided into a regular
// grid, and a cell counts if its centre is visible. Not exact: the error is about the fraction of the source
// in cells on the borders of shadows, and the result jumps from point to point.
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
