// solver/geometry/planar_sets.h
//
// Hulls, differences and intersections of convex polygons that share a plane in space.

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/polygon.h"

namespace penumbra {

// Appends to `left` the convex pieces of the convex polygon `from` that lie outside the convex polygon
// `hole`, which runs counter-clockwise about the unit normal of their plane. Vertices within `crack` [m] of
// the line through an edge of the hole count as lying on it, and pieces no wider than `crack` are left out.
void Subtract(const Polygon3& from, std::span<const Vec3> hole, const Vec3& normal, double crack,
              std::vector<Polygon3>& left);

// The common part of two convex polygons in a plane with that unit normal, both counter-clockwise about it;
// `with` counts as reaching `margin` [m] farther than it does. Empty if they have none.
Polygon3 Intersect(Polygon3 polygon, std::span<const Vec3> with, const Vec3& normal, double margin);

// The convex hull of points in a plane, counter-clockwise about its unit normal; empty if they lie on a line.
Polygon3 ConvexHull(std::span<const Vec3> points, const Vec3& normal);

}  // namespace penumbra
