// solver/scene/curved_surfaces.h
//
// Curved surfaces cut into planar polygons. The corners of the polygons lie on the curved surface, and
// (distance of the surface from the polygons) / (radius of the surface) is at most kCurveTolerance. The
// vertices of a polygon are counter-clockwise seen from outside the surface; Reversed() reverses them.
// Surfaces with the same axis and radius have the same corners up to rounding errors, so that a disk closes a
// cylinder.

#pragma once

#include <vector>

#include "solver/geometry/polygon.h"

namespace penumbra {

// The largest distance of a curved surface from its polygons, divided by the radius of the surface: 1 -
// cos(pi / n) if a circle is divided into n pieces. The relative error of the area of the polygons is less
// than 2 * kCurveTolerance.
inline constexpr double kCurveTolerance = 0.01;

std::vector<Polygon3> SpherePolygons(const Vec3& centre, double radius);
// The side surface of a truncated cone with the axis from `from` to `to` and a radius for each end; a
// cylinder if the radii are equal, a pointed cone if one radius is 0.
std::vector<Polygon3> ConePolygons(const Vec3& from, double from_radius, const Vec3& to, double to_radius);
// A flat ring between two radii, whose front looks along the normal.
std::vector<Polygon3> RingPolygons(const Vec3& centre, const Vec3& normal, double inner, double outer);
// A torus: a circle of radius `minor` whose centre moves around the axis on a circle of radius `major` >=
// `minor`.
std::vector<Polygon3> TorusPolygons(const Vec3& centre, const Vec3& axis, double major, double minor);

// The same polygons with reversed order of vertices, so that fronts become backs.
std::vector<Polygon3> Reversed(std::vector<Polygon3> polygons);

}  // namespace penumbra
