// solver/visibility/clipping.h

#pragma once

#include "solver/visibility/occlusion_method.h"

namespace penumbra {

// Cuts what each occluder covers out of the source; the rest remains as convex pieces. The fastest exact
// method.
class Clipping final : public OcclusionMethod {
 public:
  double VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                           const Vec3& normal) const override;
};

}  // namespace penumbra
