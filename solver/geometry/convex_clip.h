// solver/geometry/convex_clip.h
//
// Clipping of convex polygons in the plane. The results are exact up to rounding errors for every input; no
// function fails.

#pragma once

#include <span>

#include "solver/geometry/polygon.h"

namespace penumbra {

// The part of the convex polygon whose points p satisfy dot(outwards, p - point) <= 0; an empty polygon if
// this part has no area. Vertices v with |dot(outwards, v - point)| <= tolerance count as lying on the border
// line.
Polygon2 ClipToHalfPlane(std::span<const Vec2> polygon, const Vec2& outwards, const Vec2& point,
                         double tolerance = 0);

// The intersection of two convex polygons, both counter-clockwise; an empty polygon if they do not overlap.
Polygon2 IntersectConvex(Polygon2 polygon, std::span<const Vec2> with);

// Divides the part of a convex polygon outside the convex polygon `hole` into convex pieces, and appends the
// pieces to `left`. Both polygons are counter-clockwise. Pieces whose width is at most `crack` are dropped.
void SubtractConvex(const Polygon2& polygon, std::span<const Vec2> hole, double crack,
                    std::vector<Polygon2>& left);

// The narrowest strip between two parallel lines that contains the convex polygon: its width, and the unit
// vector perpendicular to the lines. The width of the strip is zero for a polygon with fewer than three
// vertices.
struct Strip {
  double width = 0;
  Vec2 across = Vec2::UnitX();
};
Strip NarrowestStrip(std::span<const Vec2> polygon);

}  // namespace penumbra
