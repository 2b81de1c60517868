// solver/visibility/point/solid_outline.h
//
// A convex solid as seen from a point: one polygon instead of the overlapping or adjacent polygons of its
// sides.

#pragma once

#include "solver/scene/scene.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {

struct SolidOutline {
  // Empty if the sides define no single outline: the point lies inside the solid, the point lies in the plane
  // of a side and has an approach, or light can pass through two missing sides. The patches then block one by
  // one.
  DirectionPolygon seen;
  // A missing side faces the point, so that light enters the solid. The outline then tells what the solid
  // hides only if the whole solid lies before the plane of the observed patch.
  bool entered = false;
};

// The outline of the solid as seen from the point; only of the part before the plane of `before`, unless
// `before` is null. Edges of the outline equal edges of patches to the bit.
SolidOutline SeenOutline(const ReceiverPoint& at, const ConvexSolid& solid, const Patch* before);

}  // namespace penumbra
