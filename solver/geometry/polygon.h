// solver/geometry/polygon.h
//
// Planar polygons in space and the frames that carry them to two dimensions. Vertices run counter-clockwise
// seen from the front; lengths are in metres.

#pragma once

#include <span>
#include <utility>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

using Polygon3 = std::vector<Vec3>;
using Polygon2 = std::vector<Vec2>;

// The vector area of the polygon: its length is the area [m^2], its direction the front normal (Newell's sum,
// taken about the first vertex so that distant polygons keep their digits). Zero for fewer than three
// vertices.
Vec3 VectorArea(std::span<const Vec3> polygon);

// The area's centroid; the mean of the vertices where the area is zero.
Vec3 Centroid(std::span<const Vec3> polygon);

// The two vertices farthest apart, the lower index first. The time is linear in the number of vertices: where
// there are more than 512, the pair may be half a per cent nearer to each other than the farthest one.
std::pair<std::size_t, std::size_t> FarthestPair(std::span<const Vec3> polygon);

// Their distance [m].
double Diameter(std::span<const Vec3> polygon);

// Twice-signed area / 2 of a polygon in the plane [m^2], positive when it runs counter-clockwise.
double SignedArea(std::span<const Vec2> polygon);

// An orthonormal frame: u x v = n. Local coordinates (x, y) lie in the plane, z along n.
struct Frame {
  Vec3 origin = Vec3::Zero();
  Vec3 u = Vec3::UnitX(), v = Vec3::UnitY(), n = Vec3::UnitZ();

  Vec2 ToPlane(const Vec3& p) const { return {u.dot(p - origin), v.dot(p - origin)}; }
  Vec3 FromPlane(const Vec2& p) const { return origin + p.x() * u + p.y() * v; }
};

// A frame at `origin` whose n is the unit vector `normal`; u and v are chosen by a fixed rule.
Frame MakeFrame(const Vec3& origin, const Vec3& normal);

// A frame at the polygon's first vertex, n its front normal, u along its first edge of nonzero length.
// REQUIRES: the polygon's area is not zero.
Frame PolygonFrame(std::span<const Vec3> polygon);

// The part of the convex polygon where normal . (p - point) >= 0; empty where nothing of positive area can
// remain. Vertices whose height is at most `tolerance` count as lying in the plane.
Polygon3 ClipToHalfSpace(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& point,
                         double tolerance = 0);

// True if p lies in the convex polygon or within `tolerance` [m] of it; p is taken to lie in its plane.
bool ConvexContains(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& p, double tolerance);

}  // namespace penumbra
