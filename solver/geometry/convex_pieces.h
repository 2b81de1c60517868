// solver/geometry/convex_pieces.h
//
// Partitions triangulated regions of the plane into few convex pieces: triangles and quadrilaterals.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// A triangle or a convex quadrilateral, given by the indices of its vertices in counter-clockwise order;
// vertex[3] is -1 in a triangle.
struct ConvexPiece {
  std::array<std::int32_t, 4> vertex = {-1, -1, -1, -1};

  int Size() const { return vertex[3] < 0 ? 3 : 4; }
};

// A corner of a polygon counts as straight if the sine of its turning angle is at most kStraightSine. The
// value of kStraightSine exceeds the effect of rounding the coordinates of three points on a line, even on
// lines far from the origin.
inline constexpr double kStraightSine = 1e-9;

// The shape quality of a quadrilateral: the smallest sine of its corner angles, 1 for a rectangle. The shape
// quality is at most 0 if the quadrilateral is not convex or has a straight corner.
double QuadrilateralQuality(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

// Returns the indices of the polygon's vertices, without the vertices at straight corners; at least three
// vertices remain.
std::vector<std::int32_t> WithoutStraightCorners(std::span<const Vec2> outline);

// Joins pairs of triangles with a common edge to convex quadrilaterals: first the triangles that have only
// one possible partner, then the pairs of the best quality. The vertex list of a convex piece begins with the
// smallest index; the pieces are sorted by their first triangle.
std::vector<ConvexPiece> JoinTriangles(std::span<const Vec2> vertices,
                                       std::span<const std::array<std::int32_t, 3>> triangles);

}  // namespace penumbra
