// solver/geometry/convex_pieces.h
//
// Partitions regions of the plane into few convex triangles and quadrilaterals.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// Three or four indices of vertices, counter-clockwise; the fourth of a triangle is -1.
struct ConvexPiece {
  std::array<std::int32_t, 4> vertex = {-1, -1, -1, -1};

  int Size() const { return vertex[3] < 0 ? 3 : 4; }
};

// A corner counts as straight if the sine of its turn is at most this: what the rounding of coordinates
// leaves of three points on a line, with room for lines far from the origin.
inline constexpr double kStraightSine = 1e-9;

// How well shaped the quadrilateral is: the smallest sine of its corners, 1 for a rectangle. 0 or less unless
// it is convex with four corners that are not straight.
double QuadrilateralQuality(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

// Indices of the outline's vertices without those in straight corners; at least three remain.
std::vector<std::int32_t> WithoutStraightCorners(std::span<const Vec2> outline);

// Joins pairs of triangles with a common edge to convex quadrilaterals: first those that only one partner can
// take, then the well-shaped ones. Each piece begins with the smallest index of its vertices; pieces ascend
// by their first triangle.
std::vector<ConvexPiece> JoinTriangles(std::span<const Vec2> vertices,
                                       std::span<const std::array<std::int32_t, 3>> triangles);

}  // namespace penumbra
