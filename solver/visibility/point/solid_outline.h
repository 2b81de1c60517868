// solver/visibility/point/solid_outline.h
//
// The outline of a convex solid as seen from a point: one polygon replaces the overlapping or adjacent
// polygons of the solid's sides.

#pragma once

#include "solver/scene/scene.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {

struct SolidOutline {
  // The outline; empty if the sides define no single outline: the point lies inside the solid, the point lies
  // in the plane of a side and has an approach direction, or light can pass through two missing sides. If the
  // outline is empty, use the sides as separate blockers.
  DirectionPolygon seen;
  // True if a missing side faces the point, so that light can enter the solid. If `entered` is true, the
  // region that the solid hides on another patch is bounded by the outline only if the whole solid lies
  // before the plane of that patch.
  bool entered = false;
};

// The outline of the solid as seen from the point. If `before` is not null, the outline is that of the part
// of the solid before the plane of `before`. Edges of the outline are bit-identical to edges of patches.
SolidOutline SeenOutline(const ReceiverPoint& at, const ConvexSolid& solid, const Patch* before);

}  // namespace penumbra
