// solver/geometry/region_difference.h
//
// The difference of a polygon and other polygons in the same plane. Borders of the polygons may coincide
// exactly, up to rounding errors, or up to the precision of the coordinates in a text file. The difference of
// polygons is found for every input, without failure.
//
// First, corners and edges within a snap distance of each other are made equal. Only corners of the
// subtracted polygons move, never those of the outline. Second, one constrained triangulation of all polygons
// distinguishes the inside of the difference from the outside.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/constrained_triangulation.h"
#include "solver/geometry/polygon.h"

namespace penumbra {

// The snap distance, within which two corners or edges count as one. Along a coordinate axis, the snap
// distance is the unit `step` to which this coordinate is rounded in the file. In every direction, the snap
// distance is at least `base`.
struct SnapTolerance {
  double base = 0;
  Vec2 step = Vec2::Zero();  // the unit to which coordinates are rounded, along x and along y

  // The snap distance in the direction of `normal`, the unit normal of an edge.
  double Across(const Vec2& normal) const { return std::max(base, normal.cwiseAbs().dot(step)); }
  bool SamePlace(const Vec2& a, const Vec2& b) const {
    const Vec2 apart = (a - b).cwiseAbs();
    return apart.squaredNorm() <= base * base || (apart.x() <= step.x() && apart.y() <= step.y());
  }
};

struct RegionDifference {
  // The list `vertices` holds the unchanged vertices of the outline, then the vertices of the subtracted
  // polygons, moved by at most the snap distance, and then the crossings of edges. Every input vertex has an
  // entry in the list `vertices`, in input order.
  std::vector<Vec2> vertices;
  // The triangles of the difference, counter-clockwise. Coincident vertices share one index, except if the
  // triangulation failed and SubtractByClipping() was used.
  std::vector<std::array<std::int32_t, 3>> triangles;
};

class RegionSubtractor {
 public:
  // Subtracts the simple polygons `cuts` from the simple polygon `outline`; all polygons are
  // counter-clockwise. Parts of the difference whose width is less than the snap distance everywhere are
  // dropped.
  RegionDifference Subtract(std::span<const Vec2> outline, std::span<const Polygon2> cuts,
                            const SnapTolerance& reach);

  // Partitions a simple polygon into convex polygons.
  std::vector<Polygon2> ConvexParts(std::span<const Vec2> outline);

 private:
  // The fallback for Subtract() if the triangulation fails: convex parts of the polygons are clipped one by
  // one, without a common mesh.
  RegionDifference SubtractByClipping(std::span<const Vec2> outline, std::span<const Polygon2> cuts,
                                      const SnapTolerance& reach);

  ConstrainedTriangulator triangulator_;
};

}  // namespace penumbra
