// solver/visibility/point/receiver_point.h

#pragma once

#include "solver/geometry/vec.h"

namespace penumbra {

// A receiver point: a point on a surface at which irradiance is computed, at the point itself or as a
// one-sided limit.
struct ReceiverPoint {
  Vec3 position = Vec3::Zero();  // the position of the receiver point [m]
  Vec3 normal = Vec3::UnitZ();   // the unit normal of the surface at the receiver point
  // For a one-sided limit, `approach` is a vector of any length from the point towards the region for which
  // the limit is taken. If `approach` is zero, no limit is taken: a polygon whose plane contains the point
  // neither lights the point nor blocks light.
  Vec3 approach = Vec3::Zero();
  // The uncertainty of the point is the largest distance of `position` from the intended position [m], in
  // addition to the rounding of the coordinates. Planes whose distance from the point is at most
  // `uncertainty` count as containing the point. The uncertainty is 0 for points that users give.
  double uncertainty = 0;
};

}  // namespace penumbra
