#include "solver/transport/links/cubature.h"

#include <array>
#include <cmath>

#include "solver/base/check.h"

namespace penumbra {
namespace {

double TriangleArea(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5 * (b - a).cross(c - a).norm(); }

// Three interior points (Hammer and Stroud 1956); weights include the area.
void AddTriangle(const Vec3& a, const Vec3& b, const Vec3& c, int refinement,
                 std::vector<CubaturePoint>& points) {
  if (refinement > 0) {
    const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    AddTriangle(a, ab, ca, refinement - 1, points);
    AddTriangle(ab, b, bc, refinement - 1, points);
    AddTriangle(ca, bc, c, refinement - 1, points);
    AddTriangle(bc, ca, ab, refinement - 1, points);
    return;
  }
  const double third = TriangleArea(a, b, c) / 3;
  points.push_back({(4 * a + b + c) / 6, third});
  points.push_back({(a + 4 * b + c) / 6, third});
  points.push_back({(a + b + 4 * c) / 6, third});
}

// Two Gauss-Legendre points along each parameter of the bilinear map; weights include the Jacobian.
void AddQuadrilateral(const std::array<Vec3, 4>& v, int refinement, std::vector<CubaturePoint>& points) {
  if (refinement > 0) {
    const std::array<Vec3, 4> mid = {0.5 * (v[0] + v[1]), 0.5 * (v[1] + v[2]), 0.5 * (v[2] + v[3]),
                                     0.5 * (v[3] + v[0])};
    const Vec3 centre = 0.25 * (v[0] + v[1] + v[2] + v[3]);
    AddQuadrilateral({v[0], mid[0], centre, mid[3]}, refinement - 1, points);
    AddQuadrilateral({mid[0], v[1], mid[1], centre}, refinement - 1, points);
    AddQuadrilateral({centre, mid[1], v[2], mid[2]}, refinement - 1, points);
    AddQuadrilateral({mid[3], centre, mid[2], v[3]}, refinement - 1, points);
    return;
  }
  static const double offset = 0.5 / std::sqrt(3.0);
  const std::array<double, 2> at = {0.5 - offset, 0.5 + offset};
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const double s = at[i], t = at[j];
      const Vec3 ds = (1 - t) * (v[1] - v[0]) + t * (v[2] - v[3]),
                 dt = (1 - s) * (v[3] - v[0]) + s * (v[2] - v[1]);
      points.push_back({(1 - t) * ((1 - s) * v[0] + s * v[1]) + t * ((1 - s) * v[3] + s * v[2]),
                        0.25 * ds.cross(dt).norm()});
    }
}

}  // namespace

std::vector<CubaturePoint> Cubature(std::span<const Vec3> polygon, int refinement) {
  PENUMBRA_CHECK(polygon.size() >= 3);
  std::vector<CubaturePoint> points;
  if (polygon.size() == 4) {
    AddQuadrilateral({polygon[0], polygon[1], polygon[2], polygon[3]}, refinement, points);
  } else {
    for (std::size_t i = 2; i < polygon.size(); ++i)
      AddTriangle(polygon[0], polygon[i - 1], polygon[i], refinement, points);
  }
  double total = 0;
  for (const CubaturePoint& point : points) total += point.weight;
  for (CubaturePoint& point : points) point.weight /= total;
  return points;
}

}  // namespace penumbra
