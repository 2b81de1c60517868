// solver/visibility/point/receiver_point.h

#pragma once

#include "solver/geometry/vec.h"

namespace penumbra {

// Where irradiance is asked for, exactly or as a limit from one side.
struct ReceiverPoint {
  Vec3 position = Vec3::Zero();  // [m]
  Vec3 normal = Vec3::UnitZ();   // unit
  // The direction from the point towards the region that asks, for a one-sided limit; need not be unit. Zero:
  // the integral itself, to which a polygon whose plane contains the point adds nothing and from which it
  // takes nothing.
  Vec3 approach = Vec3::Zero();
  // How far the position may be from where it is meant to be [m], beside the rounding of its coordinates.
  // Planes within this distance are taken to contain the point. 0 for points that users give.
  double uncertainty = 0;
};

}  // namespace penumbra
