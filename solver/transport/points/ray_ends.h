// solver/transport/points/ray_ends.h
//
// The ends of rays between surfaces. Rays are traced in single precision, so that an end must lie a little
// before its surface.

#pragma once

#include "solver/scene/scene.h"
#include "solver/scene/tolerances.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// The distance of the ends from their surfaces [m]. Single precision rounds coordinates to about a thirtieth
// of ContactGap().
inline double RayLift(const Scene& scene) { return 2 * ContactGap(scene); }

// The start of the rays from a point. The start lies `lift` before the plane of the point. If the point has
// an approach direction, the start is also moved by `lift` in that direction, away from surfaces at the
// point.
inline Vec3 RayStart(const ReceiverPoint& at, double lift) {
  Vec3 start = at.position + lift * at.normal;
  if (!at.approach.isZero(0)) start += lift * at.approach.normalized();
  return start;
}

}  // namespace penumbra
