// solver/geometry/convex_clip.h
//
// Convex polygons in the plane, clipped by lines. Rounding can make a result wrong by a rounding, and no
// worse: nothing here fails for any input.

#pragma once

#include <span>

#include "solver/geometry/polygon.h"

namespace penumbra {

// The part of the convex polygon where outwards . (p - point) <= 0; empty if that is no more than a line.
// Vertices at most `tolerance` from the border count as lying on it.
Polygon2 ClipToHalfPlane(std::span<const Vec2> polygon, const Vec2& outwards, const Vec2& point,
                         double tolerance = 0);

// The common part of two convex polygons that run counter-clockwise; empty if they have none.
Polygon2 IntersectConvex(Polygon2 polygon, std::span<const Vec2> with);

// The parts of the convex polygon outside of the convex `hole`, both counter-clockwise: appended to `left`,
// without those no wider than `crack`.
void SubtractConvex(const Polygon2& polygon, std::span<const Vec2> hole, double crack,
                    std::vector<Polygon2>& left);

// The narrowest strip between two parallel lines that holds the convex polygon: its width, and the unit
// vector across it. Zero for fewer than three vertices.
struct Strip {
  double width = 0;
  Vec2 across = Vec2::UnitX();
};
Strip NarrowestStrip(std::span<const Vec2> polygon);

}  // namespace penumbra
