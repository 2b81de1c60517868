// solver/geometry/convex_clip.h
//
// Clipping of convex polygons in the plane. Results are exact to rounding for every input; no function fails.

#pragma once

#include <span>

#include "solver/geometry/polygon.h"

namespace penumbra {

// The points p of the convex polygon with dot(outwards, p - point) <= 0; empty if they lie on a line.
// Vertices within `tolerance` of the border line count as lying on it.
Polygon2 ClipToHalfPlane(std::span<const Vec2> polygon, const Vec2& outwards, const Vec2& point,
                         double tolerance = 0);

// The intersection of two convex polygons, both counter-clockwise; empty if they do not overlap.
Polygon2 IntersectConvex(Polygon2 polygon, std::span<const Vec2> with);

// Appends to `left` convex pieces of the part of the convex polygon outside the convex `hole`, both
// counter-clockwise. Pieces of a width of at most `crack` are dropped.
void SubtractConvex(const Polygon2& polygon, std::span<const Vec2> hole, double crack,
                    std::vector<Polygon2>& left);

// The narrowest strip between two parallel lines that contains the convex polygon: its width, and the unit
// vector perpendicular to the lines. The width is zero for fewer than three vertices.
struct Strip {
  double width = 0;
  Vec2 across = Vec2::UnitX();
};
Strip NarrowestStrip(std::span<const Vec2> polygon);

}  // namespace penumbra
