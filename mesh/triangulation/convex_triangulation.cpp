#include "mesh/triangulation/convex_triangulation.h"

#include <limits>

#include "solver/base/check.h"

namespace penumbra {
namespace {

// Triangulates the part of the outline from `first` to `last`, which lies beyond the chord between them. The
// third corner of the triangle at the chord is the corner that sees the chord under the largest angle.
void TriangulateBeyond(std::span<const Vec2> outline, std::int32_t first, std::int32_t last,
                       std::vector<std::array<std::int32_t, 3>>& triangles) {
  if (last - first < 2) return;
  // Cotangents with a smaller difference are equal: the corners lie on one circle.
  constexpr double kTie = 1e-12;
  double smallest = std::numeric_limits<double>::infinity();
  std::int32_t apex = -1;
  for (std::int32_t k = first + 1; k < last; ++k) {
    const Vec2 a = outline[last] - outline[k], b = outline[first] - outline[k];
    const double cross = Cross2(a, b), dot = a.dot(b);
    if (!(cross > 0)) continue;
    const double cotangent = dot / cross;
    if (apex >= 0 && cotangent >= smallest - kTie * (1 + std::abs(smallest))) continue;
    smallest = cotangent;
    apex = k;
  }
  // Only rounding errors can leave a chord without a corner beyond it; any corner is acceptable then.
  if (apex < 0) apex = (first + last) / 2;
  triangles.push_back({first, apex, last});
  TriangulateBeyond(outline, first, apex, triangles);
  TriangulateBeyond(outline, apex, last, triangles);
}

}  // namespace

void TriangulateConvex(std::span<const Vec2> outline, std::vector<std::array<std::int32_t, 3>>& triangles) {
  PENUMBRA_CHECK(outline.size() >= 3);
  TriangulateBeyond(outline, 0, static_cast<std::int32_t>(outline.size()) - 1, triangles);
}

}  // namespace penumbra
