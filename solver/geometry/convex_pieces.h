// solver/geometry/convex_pieces.h
//
// Partitions triangulated regions of the plane into convex triangles and quadrilaterals, with few pieces.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// Indices of three or four vertices, counter-clockwise; vertex[3] is -1 in a triangle.
struct ConvexPiece {
  std::array<std::int32_t, 4> vertex = {-1, -1, -1, -1};

  int Size() const { return vertex[3] < 0 ? 3 : 4; }
};

// A corner counts as straight if the sine of its turning angle is at most kStraightSine. The value exceeds
// the effect of rounding the coordinates of three points on a line, with a margin for lines far from the
// origin.
inline constexpr double kStraightSine = 1e-9;

// The shape quality of a quadrilateral: the smallest sine of its corner angles, 1 for a rectangle. The
// quality is at most 0 if the quadrilateral is not convex or has a straight corner.
double QuadrilateralQuality(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

// Indices of the outline's vertices, without those at straight corners; at least three remain.
std::vector<std::int32_t> WithoutStraightCorners(std::span<const Vec2> outline);

// Joins pairs of triangles with a common edge to convex quadrilaterals: first the triangles that have only
// one possible partner, then the pairs of the best quality. Each piece begins with its smallest vertex index;
// pieces are sorted by their first triangle.
std::vector<ConvexPiece> JoinTriangles(std::span<const Vec2> vertices,
                                       std::span<const std::array<std::int32_t, 3>> triangles);

}  // namespace penumbra
