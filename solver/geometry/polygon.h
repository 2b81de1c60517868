// solver/geometry/polygon.h
//
// Planar polygons in space, and frames for their two-dimensional coordinates. Vertices are counter-clockwise
// seen from the front; lengths are in metres.

#pragma once

#include <span>
#include <utility>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

using Polygon3 = std::vector<Vec3>;
using Polygon2 = std::vector<Vec2>;

// The vector area of the polygon: its length is the area [m^2], its direction the front normal. The function
// computes Newell's sum, relative to the first vertex, so that polygons far from the origin lose no digits.
// The vector area is zero for fewer than three vertices.
Vec3 VectorArea(std::span<const Vec3> polygon);

// The centroid of the area; the mean of the vertices if the area is zero.
Vec3 Centroid(std::span<const Vec3> polygon);

// The indices of the two vertices with the largest distance, the lower index first. The time is linear in the
// number of vertices: for more than 512 vertices, the distance of the result may be 0.5 % less than the
// largest.
std::pair<std::size_t, std::size_t> FarthestPair(std::span<const Vec3> polygon);

// The distance between the two vertices that FarthestPair() returns [m].
double Diameter(std::span<const Vec3> polygon);

// The signed area of a polygon in the plane [m^2], positive for counter-clockwise polygons.
double SignedArea(std::span<const Vec2> polygon);

// An orthonormal frame with u x v = n. Local coordinates are (x, y) along u and v, and z along n.
struct Frame {
  Vec3 origin = Vec3::Zero();
  Vec3 u = Vec3::UnitX(), v = Vec3::UnitY(), n = Vec3::UnitZ();

  Vec2 ToPlane(const Vec3& p) const { return {u.dot(p - origin), v.dot(p - origin)}; }
  Vec3 FromPlane(const Vec2& p) const { return origin + p.x() * u + p.y() * v; }
};

// A frame at `origin` with n = normal, a unit vector. A fixed rule determines u and v.
Frame MakeFrame(const Vec3& origin, const Vec3& normal);

// A frame at the polygon's first vertex: n is the front normal, u the direction of the first edge of nonzero
// length. REQUIRES: the polygon's area is not zero.
Frame PolygonFrame(std::span<const Vec3> polygon);

// The points p of the convex polygon with dot(normal, p - point) >= 0; empty if they have no area. Vertices v
// with |dot(normal, v - point)| <= tolerance count as lying in the plane.
Polygon3 ClipToHalfSpace(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& point,
                         double tolerance = 0);

// True if p lies in the convex polygon or within `tolerance` [m] of it. REQUIRES: p lies in the polygon's
// plane.
bool ConvexContains(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& p, double tolerance);

}  // namespace penumbra
