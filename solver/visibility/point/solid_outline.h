// solver/visibility/point/solid_outline.h
//
// The outline of a convex solid as seen from a point: one polygon replaces the overlapping or adjacent
// polygons of the solid's sides.

#pragma once

#include "solver/scene/scene.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {

struct SolidOutline {
  // The outline of the solid as seen from the point. The outline is empty if the point lies inside the solid,
  // if the point lies in the plane of a side and has an approach direction, or if light can pass through two
  // missing sides. If the outline is empty, use the sides of the solid as separate blockers.
  DirectionPolygon seen;
  // True if a missing side of the solid faces the point, so that light can enter the solid. If `entered` is
  // true, the outline bounds the region that the solid hides on another patch only if the whole solid lies in
  // front of the plane of that patch.
  bool entered = false;
};

// Returns the outline of the solid as seen from the point. If `before` is not null, the part of the solid
// behind the plane of the patch `before` is left out. Edges of the outline equal edges of patches to the bit.
SolidOutline SeenOutline(const ReceiverPoint& at, const ConvexSolid& solid, const Patch* before);

}  // namespace penumbra
