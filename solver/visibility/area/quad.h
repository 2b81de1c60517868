// solver/visibility/area/quad.h
//
// Convex quadrilaterals in a plane as bilinear images of the unit square, for integration by product
// quadrature rules.

#pragma once

#include <array>
#include <span>
#include <vector>

#include "solver/geometry/polygon.h"

namespace penumbra {

// The corners of a convex quadrilateral, counter-clockwise. In a triangle, the last corner repeats the first
// corner.
using Quad = std::array<Vec2, 4>;

// The bilinear map from (s, t) in the unit square to the quadrilateral.
inline Vec2 At(const Quad& q, double s, double t) {
  return (1 - t) * ((1 - s) * q[0] + s * q[1]) + t * ((1 - s) * q[3] + s * q[2]);
}

// The Jacobian determinant at (s, t) of the bilinear map At(): (area of the image) / (area in the unit
// square).
inline double Jacobian(const Quad& q, double s, double t) {
  const Vec2 ds = (1 - t) * (q[1] - q[0]) + t * (q[2] - q[3]),
             dt = (1 - s) * (q[3] - q[0]) + s * (q[2] - q[1]);
  return Cross2(ds, dt);
}

// Divides the convex polygon into convex quadrilaterals and at most one triangle, and appends them to
// `quads`.
inline void AddQuads(std::span<const Vec2> polygon, std::vector<Quad>& quads) {
  for (std::size_t i = 2; i < polygon.size(); i += 2)
    if (i + 1 < polygon.size())
      quads.push_back({polygon[0], polygon[i - 1], polygon[i], polygon[i + 1]});
    else
      quads.push_back({polygon[0], polygon[i - 1], polygon[i], polygon[0]});
}

inline Polygon2 ToPolygon(const Quad& quad) {
  Polygon2 polygon(quad.begin(), quad.end());
  if (quad[3] == quad[0]) polygon.pop_back();
  return polygon;
}

}  // namespace penumbra
