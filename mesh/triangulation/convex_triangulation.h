// mesh/triangulation/convex_triangulation.h
//
// The Delaunay triangulation of a convex polygon's vertices, for quadtree leaves that no discontinuity line
// crosses.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// Appends the triangles to `triangles`, as counter-clockwise triples of indices in `outline`. `outline` has
// at least three points in counter-clockwise order and is convex up to rounding. Points in the interior of a
// side of the outline are allowed. If four or more points lie on one circle, the point with the lowest index
// is preferred as corner of a triangle. The run time is quadratic in the number of points of the outline.
void TriangulateConvex(std::span<const Vec2> outline, std::vector<std::array<std::int32_t, 3>>& triangles);

}  // namespace penumbra
