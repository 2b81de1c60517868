// solver/geometry/region_difference.h
//
// The difference of a polygon and other polygons in its plane. Borders of the polygons may coincide exactly,
// to within rounding errors, or to within the precision of the coordinates in a text file. The computation
// succeeds for every input.
//
// First, corners and edges within a snap distance of each other are unified: the corners of the cutting
// polygons move, never those of the outline. Second, one constrained triangulation of all polygons
// distinguishes the inside of the difference from the outside.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/constrained_triangulation.h"
#include "solver/geometry/polygon.h"

namespace penumbra {

// The distance within which two corners or edges count as one. Along a coordinate axis, the distance is the
// unit `step` to which this coordinate is rounded in the file. In every direction, the distance is at least
// `base`.
struct SnapTolerance {
  double base = 0;
  Vec2 step = Vec2::Zero();  // along each coordinate axis

  // The distance in the direction of `normal`, the unit normal of an edge.
  double Across(const Vec2& normal) const { return std::max(base, normal.cwiseAbs().dot(step)); }
  bool SamePlace(const Vec2& a, const Vec2& b) const {
    const Vec2 apart = (a - b).cwiseAbs();
    return apart.squaredNorm() <= base * base || (apart.x() <= step.x() && apart.y() <= step.y());
  }
};

struct RegionDifference {
  // First the unchanged vertices of the outline; then the vertices of the cutting polygons, one polygon after
  // the other, moved by at most the snap distance; then crossings of edges. Every vertex of the outline and
  // of the cutting polygons has an entry, in input order.
  std::vector<Vec2> vertices;
  // Counter-clockwise. Coincident vertices share one index, except where the common triangulation failed and
  // convex parts were clipped instead.
  std::vector<std::array<std::int32_t, 3>> triangles;
};

class RegionSubtractor {
 public:
  // The part of the simple polygon `outline` outside all simple polygons `cuts`; all are counter-clockwise.
  // Parts whose width is less than the snap distance everywhere are dropped.
  RegionDifference Subtract(std::span<const Vec2> outline, std::span<const Polygon2> cuts,
                            const SnapTolerance& reach);

  // Partitions a simple polygon into convex ones.
  std::vector<Polygon2> ConvexParts(std::span<const Vec2> outline);

 private:
  // The fallback if the triangulation fails: clips convex parts one by one, without a common mesh.
  RegionDifference SubtractByClipping(std::span<const Vec2> outline, std::span<const Polygon2> cuts,
                                      const SnapTolerance& reach);

  ConstrainedTriangulator triangulator_;
};

}  // namespace penumbra
