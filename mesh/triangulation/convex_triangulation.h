// mesh/triangulation/convex_triangulation.h
//
// The Delaunay triangulation of points on the outline of a convex polygon, for leaves that nothing crosses.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// Triangles, counter-clockwise, as indices in `outline`: counter-clockwise, of at least three points, convex
// to rounding; points within a side are welcome. Of two diagonals that serve equally well the one from the
// lower index is taken. Cost: quadratic in the number of points.
void TriangulateConvex(std::span<const Vec2> outline, std::vector<std::array<std::int32_t, 3>>& triangles);

}  // namespace penumbra
