// solver/geometry/region_difference.h
//
// What is left of a polygon outside of others that share its plane, where their borders may coincide to the
// last bit, to a rounding, or to the digits of a file. Whatever the input, an answer is found.
//
// Corners and edges nearer to each other than a reach are made one beforehand, by moving those of the
// polygons that cut and never the outline. Then one constrained triangulation of all of them tells inside
// from outside.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/constrained_triangulation.h"
#include "solver/geometry/polygon.h"

namespace penumbra {

// How near two corners or edges count as one. Along a coordinate it is what the rounding of that coordinate
// makes of a common place; in any direction it is `base` at least.
struct SnapReach {
  double base = 0;
  Vec2 step = Vec2::Zero();  // of each coordinate

  // Across an edge whose unit normal is this.
  double Across(const Vec2& normal) const { return std::max(base, normal.cwiseAbs().dot(step)); }
  bool SamePlace(const Vec2& a, const Vec2& b) const {
    const Vec2 apart = (a - b).cwiseAbs();
    return apart.squaredNorm() <= base * base || (apart.x() <= step.x() && apart.y() <= step.y());
  }
};

struct RegionDifference {
  // The outline's, to the bit; those of the cuts one after the other, moved by no more than the reach; where
  // their edges cross. Those of the outline and the cuts keep their places in the order.
  std::vector<Vec2> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;  // counter-clockwise; none of the vertices is shared by
                                                       // place alone, but where all else failed
};

class RegionSubtractor {
 public:
  // The part of the simple polygon `outline` outside of all the simple polygons `cuts`; all run
  // counter-clockwise. Parts that are narrower than the reach all along are left out.
  RegionDifference Subtract(std::span<const Vec2> outline, std::span<const Polygon2> cuts,
                            const SnapReach& reach);

  // A simple polygon as convex ones.
  std::vector<Polygon2> ConvexParts(std::span<const Vec2> outline);

 private:
  // By clipping convex parts, without a common mesh.
  RegionDifference SubtractByClipping(std::span<const Vec2> outline, std::span<const Polygon2> cuts,
                                      const SnapReach& reach);

  ConstrainedTriangulator triangulator_;
};

}  // namespace penumbra
