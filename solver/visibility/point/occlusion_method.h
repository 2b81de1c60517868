// solver/visibility/point/occlusion_method.h
//
// An interface to compute the part of a source that blockers leave visible from a point. The several methods
// are alternatives, and checks of each other.

#pragma once

#include <span>

#include "solver/base/registry.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {

// Bound of the error of the exact methods, relative to the form factor of the unoccluded source, if the given
// directions and normal are taken as exact. Clipping moves a border by 8 roundings of the source's image,
// about ten times. All methods sum form factors to kFormFactorError. A source seen at a grazing angle of 1e-5
// loses one digit.
inline constexpr double kOcclusionError = 1e-12;

class OcclusionMethod {
 public:
  virtual ~OcclusionMethod() = default;

  // The form factor of a point with unit normal `normal` to the part of `source` that no occluder covers. May
  // be called from any thread. REQUIRES: `source` is convex and lies above the point's horizon; all occluders
  // lie before the source.
  virtual double VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                                   const Vec3& normal) const = 0;
};

struct OcclusionOptions {
  // Backprojection only: edges of blockers' outlines shorter than this times the source's diameter are left
  // out (thesis, Appendix A, item 6). 0: none are left out.
  double min_backprojection_segment = 0;
};

// OcclusionMethods() lists all methods.
using OcclusionRegistry = Registry<const OcclusionMethod, OcclusionOptions>;

// Clipping.
const OcclusionMethod& FastestExactMethod();

}  // namespace penumbra
