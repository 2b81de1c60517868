// mesh/triangulation/convex_triangulation.h
//
// The Delaunay triangulation of the vertices of a convex polygon, for leaves that no line crosses.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// Appends counter-clockwise triangles, as indices in `outline`. The outline has at least three points in
// counter-clockwise order and is convex up to rounding; points in the interior of a side are allowed. If four
// or more points lie on one circle, the point with the lowest index is preferred as corner of a triangle. The
// time is quadratic in the number of points.
void TriangulateConvex(std::span<const Vec2> outline, std::vector<std::array<std::int32_t, 3>>& triangles);

}  // namespace penumbra
