// solver/visibility/point/solid_outline.h
//
// What a point sees of a convex solid, as one polygon instead of several that overlap or meet.

#pragma once

#include "solver/scene/scene.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {

struct SolidOutline {
  // Empty where sides tell no single outline: the point lies inside, or in the plane of a side that is
  // approached from one side, or light passes through two missing sides. There the patches must be looked at
  // one by one.
  DirectionPolygon seen;
  // Some light enters through a missing side: nothing stops it before it leaves through another, which must
  // not lie in the plane of what is looked at or beyond.
  bool entered = false;
};

// The outline of the solid as seen from the point, or of its part before a plane (`before`; may be null). Its
// borders are those of patches, to the bit.
SolidOutline SeenOutline(const ReceiverPoint& at, const ConvexSolid& solid, const Patch* before);

}  // namespace penumbra
