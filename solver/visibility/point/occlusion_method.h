// solver/visibility/point/occlusion_method.h
//
// What blockers leave of a source, as seen from a point: several methods behind one interface, to choose from
// and to check against each other.

#pragma once

#include <span>

#include "solver/base/registry.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {

// Largest error of the exact methods, relative to the unoccluded source, for exactly the directions and the
// normal given: clipping moves borders by 8 roundings of the source's image, some ten times over; all sum
// form factors to kFormFactorError; a source seen as flatly as 1e-5 loses a digit.
inline constexpr double kOcclusionError = 1e-12;

class OcclusionMethod {
 public:
  virtual ~OcclusionMethod() = default;

  // The form factor of a point with unit normal `normal` to what none of the occluders covers of `source`, a
  // convex polygon of directions above the horizon. All occluders lie before the source. Safe from any
  // thread.
  virtual double VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                                   const Vec3& normal) const = 0;
};

struct OcclusionOptions {
  // Backprojection: edges of blockers' outlines shorter than this, relative to the source's diameter, are
  // left out (thesis, Appendix A, 6). 0: none.
  double min_backprojection_segment = 0;
};

// OcclusionMethods() holds all methods.
using OcclusionRegistry = Registry<const OcclusionMethod, OcclusionOptions>;

// Clipping.
const OcclusionMethod& FastestExactMethod();

}  // namespace penumbra
