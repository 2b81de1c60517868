// solver/visibility/point/sampled_visibility.h

#pragma once

#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {

// What the thesis tried first and gave up (chapter 6): the source is divided into a regular grid, and a part
// counts if its middle is visible. Not exact: off by about the part of the source that the parts along
// shadows' edges make up, and jumping from point to point.
class SampledVisibility final : public OcclusionMethod {
 public:
  // Each quadrilateral or triangle of the source is divided into `divisions` squared parts.
  explicit SampledVisibility(int divisions = 16) : divisions_(divisions) {}

  double VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                           const Vec3& normal) const override;

 private:
  int divisions_;
};

OcclusionRegistry::Method SampledVisibilityMethod();

}  // namespace penumbra
