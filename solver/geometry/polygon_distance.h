// solver/geometry/polygon_distance.h
//
// Distances of points from segments and from convex polygons in space.

#pragma once

#include <span>

#include "solver/geometry/vec.h"

namespace penumbra {

// The distance of x from the segment pq [m].
double DistanceToSegment(const Vec3& x, const Vec3& p, const Vec3& q);

// The point of the convex planar polygon nearest to x. `normal` is the polygon's unit normal.
Vec3 NearestInPolygon(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& x);

// The distance of x from the convex planar polygon [m]. `normal` is the polygon's unit normal.
double DistanceToPolygon(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& x);

}  // namespace penumbra
