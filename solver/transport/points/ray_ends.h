// solver/transport/points/ray_ends.h
//
// The end points of rays between surfaces. Rays are traced in single precision, so that the end point of a
// ray must lie a little in front of the surface on which the ray ends.

#pragma once

#include "solver/scene/scene.h"
#include "solver/scene/tolerances.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// The distance of a ray's end points from their surfaces [m]. Single precision rounds coordinates to about a
// thirtieth of ContactGap().
inline double RayLift(const Scene& scene) { return 2 * ContactGap(scene); }

// Returns the starting position of rays from a receiver point. The start of the rays lies at the distance
// `lift` [m] in front of the plane of the receiver point. If ReceiverPoint::approach is set, the start of the
// rays is also moved by `lift` in the direction `approach`, away from surfaces that touch the point.
inline Vec3 RayStart(const ReceiverPoint& at, double lift) {
  Vec3 start = at.position + lift * at.normal;
  if (!at.approach.isZero(0)) start += lift * at.approach.normalized();
  return start;
}

}  // namespace penumbra
