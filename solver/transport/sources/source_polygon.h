// solver/transport/sources/source_polygon.h
//
// The polygons of sources, triangles and quadrilaterals, and their division into four quarters.

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
  std::array<Vec3, 4> vertex = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // [m]
  std::int32_t size = 0;  // number of vertices: 3 or 4

  SourcePolygon() = default;
  // REQUIRES: three or four vertices.
  explicit SourcePolygon(std::span<const Vec3> vertices);
  std::span<const Vec3> Vertices() const { return {vertex.data(), static_cast<std::size_t>(size)}; }
  bool operator==(const SourcePolygon& other) const;
};

// The triangles and quadrilaterals, all with the first vertex of the convex polygon, that tile the polygon.
std::vector<SourcePolygon> Fan(std::span<const Vec3> convex);

// The quarters of a polygon, with its edges' midpoints as corners. Quarter k < 3 of a triangle and quarter k
// of a quadrilateral contain vertex k; quarter 3 of a triangle is the one in the middle.
std::array<SourcePolygon, 4> Quarters(const SourcePolygon& whole);
// The polygon that has these four as its Quarters(), up to the rounding of midpoints; nothing if there is
// none.
std::optional<SourcePolygon> JoinQuarters(const SourcePolygon& a, const SourcePolygon& b,
                                          const SourcePolygon& c, const SourcePolygon& d);

}  // namespace penumbra
