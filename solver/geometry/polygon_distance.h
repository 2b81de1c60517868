// solver/geometry/polygon_distance.h
//
// How far points are from segments and from convex polygons in space.

#pragma once

#include <span>

#include "solver/geometry/vec.h"

namespace penumbra {

// The distance of x from the segment from p to q [m].
double DistanceToSegment(const Vec3& x, const Vec3& p, const Vec3& q);

// The point of a convex planar polygon with the unit normal that is nearest to x.
Vec3 NearestInPolygon(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& x);

// The distance of x from a convex planar polygon with the unit normal [m].
double DistanceToPolygon(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& x);

}  // namespace penumbra
