// solver/geometry/polygon.h
//
// Planar polygons in space, and frames for their two-dimensional coordinates. The vertices of a polygon are
// counter-clockwise seen from the front; lengths are in metres.

#pragma once

#include <span>
#include <utility>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

using Polygon3 = std::vector<Vec3>;
using Polygon2 = std::vector<Vec2>;

// The vector area of the polygon: the length of the vector is the area [m^2], its direction is the front
// normal. Newell's sum is computed relative to the first vertex, so that polygons far from the origin lose no
// digits. The vector area of a polygon with fewer than three vertices is zero.
Vec3 VectorArea(std::span<const Vec3> polygon);

// The centroid of the polygon's area; the mean of the vertices if the area is zero.
Vec3 Centroid(std::span<const Vec3> polygon);

// The indices of the two vertices that are farthest apart, the lower index first. The time is linear in the
// number of vertices, because for more than 512 vertices the search is approximate: the distance of the
// returned vertices may be 0.5 % less than the largest distance.
std::pair<std::size_t, std::size_t> FarthestPair(std::span<const Vec3> polygon);

// The distance between the two vertices that FarthestPair() returns [m].
double Diameter(std::span<const Vec3> polygon);

// The signed area of a polygon in the plane [m^2], positive for counter-clockwise polygons.
double SignedArea(std::span<const Vec2> polygon);

// An orthonormal frame with u x v = n. The local coordinates x, y and z are measured along u, v and n.
struct Frame {
  Vec3 origin = Vec3::Zero();
  Vec3 u = Vec3::UnitX(), v = Vec3::UnitY(), n = Vec3::UnitZ();

  Vec2 ToPlane(const Vec3& p) const { return {u.dot(p - origin), v.dot(p - origin)}; }
  Vec3 FromPlane(const Vec2& p) const { return origin + p.x() * u + p.y() * v; }
};

// A frame with the given origin whose n is the unit vector `normal`. A fixed rule determines u and v from n.
Frame MakeFrame(const Vec3& origin, const Vec3& normal);

// A frame whose origin is the polygon's first vertex, n the front normal, and u the direction of the first
// edge of nonzero length. REQUIRES: the polygon's area is not zero.
Frame PolygonFrame(std::span<const Vec3> polygon);

// The part of the convex polygon whose points p satisfy dot(normal, p - point) >= 0; an empty polygon if this
// part has no area. Vertices v with |dot(normal, v - point)| <= tolerance count as lying in the plane.
Polygon3 ClipToHalfSpace(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& point,
                         double tolerance = 0);

// True if the point p lies in the convex polygon or at most `tolerance` [m] outside. REQUIRES: p lies in the
// polygon's plane.
bool ConvexContains(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& p, double tolerance);

}  // namespace penumbra
