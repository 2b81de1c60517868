// solver/scene/curved_surfaces.h
//
// Curved surfaces cut into planar polygons. The corners of the polygons lie on the surface, and the surface
// lies at most kCurveTolerance of its radius away from the polygons. Polygons run counter-clockwise seen from
// the outside of the surface; Reversed() turns them. Surfaces with the same axis and radius share corners to
// rounding, so that a disk closes a cylinder.

#pragma once

#include <vector>

#include "solver/geometry/polygon.h"

namespace penumbra {

// The largest distance of a curved surface from its polygons, relative to its radius: 1 - cos(pi / n) for n
// pieces a circle. The area of the polygons is smaller than that of the surface by less than twice this
// share.
inline constexpr double kCurveTolerance = 0.01;

std::vector<Polygon3> SpherePolygons(const Vec3& centre, double radius);
// The part of a cone between circles of two radii around the axis from `from` to `to`; a cylinder if the
// radii are equal, a pointed cone if one is 0.
std::vector<Polygon3> ConePolygons(const Vec3& from, double from_radius, const Vec3& to, double to_radius);
// A disk between two radii, which looks along the normal.
std::vector<Polygon3> RingPolygons(const Vec3& centre, const Vec3& normal, double inner, double outer);
// A torus: the circle of `minor` radius turns around the axis at the distance `major` >= minor from it.
std::vector<Polygon3> TorusPolygons(const Vec3& centre, const Vec3& axis, double major, double minor);

// The polygons, seen from the other side.
std::vector<Polygon3> Reversed(std::vector<Polygon3> polygons);

}  // namespace penumbra
