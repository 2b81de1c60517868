// solver/geometry/planar_sets.h
//
// Hulls, differences and intersections of convex polygons that lie in a common plane in space.

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/polygon.h"

namespace penumbra {

// Divides the part of the convex polygon `from` outside the convex polygon `hole` into convex pieces, and
// appends the pieces to `left`. The polygon `hole` is counter-clockwise about the unit normal of the common
// plane. Vertices within `crack` [m] of the line through an edge of `hole` count as lying on the line. Pieces
// whose width is at most `crack` are dropped.
void Subtract(const Polygon3& from, std::span<const Vec3> hole, const Vec3& normal, double crack,
              std::vector<Polygon3>& left);

// The intersection of the polygon `polygon` with the polygon `with`, which is enlarged by `margin` [m] on all
// sides. Both polygons are convex, lie in a common plane with the unit normal `normal`, and are
// counter-clockwise about the normal. The intersection is empty if the polygons do not overlap.
Polygon3 Intersect(Polygon3 polygon, std::span<const Vec3> with, const Vec3& normal, double margin);

// The convex hull of points in a plane, counter-clockwise about the plane's unit normal; an empty polygon if
// the points lie on a line.
Polygon3 ConvexHull(std::span<const Vec3> points, const Vec3& normal);

}  // namespace penumbra
