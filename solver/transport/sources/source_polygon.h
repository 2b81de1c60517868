// solver/transport/sources/source_polygon.h
//
// The polygons of light sources, which are triangles and quadrilaterals, and the division of such a polygon
// into four quarters.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

struct SourcePolygon {
  // Vertices of the polygon [m]; the fourth entry is unused in a triangle.
  std::array<Vec3, 4> vertex = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  std::int32_t size = 0;  // number of the polygon's vertices: 3 or 4

  SourcePolygon() = default;
  // REQUIRES: three or four vertices.
  explicit SourcePolygon(std::span<const Vec3> vertices);
  std::span<const Vec3> Vertices() const { return {vertex.data(), static_cast<std::size_t>(size)}; }
  bool operator==(const SourcePolygon& other) const;
};

// Divides a convex polygon into triangles and quadrilaterals that all contain the polygon's first vertex.
std::vector<SourcePolygon> Fan(std::span<const Vec3> convex);

// The four quarters of a polygon; the midpoints of the polygon's edges are corners of the quarters. Quarter k
// < 3 of a triangle and quarter k of a quadrilateral contain vertex k; quarter 3 of a triangle is the
// triangle in the middle.
std::array<SourcePolygon, 4> Quarters(const SourcePolygon& whole);
// The polygon whose Quarters() are a, b, c and d, up to the rounding of midpoints; nullopt if no such polygon
// exists.
std::optional<SourcePolygon> JoinQuarters(const SourcePolygon& a, const SourcePolygon& b,
                                          const SourcePolygon& c, const SourcePolygon& d);

}  // namespace penumbra
