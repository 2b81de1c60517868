#include "mesh/interpolants/triangle_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesh/interpolants/representation_error.h"

namespace penumbra {

TriangleQuality MeasureQuality(const IrradianceMesh& mesh) {
  TriangleQuality quality;
  if (mesh.triangles.empty()) return quality;
  constexpr double kDegrees = 180 / std::numbers::pi, kSlim = 5;
  std::vector<double> angles, aspects;
  double area = 0, slim_area = 0;
  std::size_t slim = 0;
  std::array<std::size_t, 6> of_angle = {};
  for (const IrradianceMesh::Triangle& t : mesh.triangles) {
    const std::array<Vec3, 3> side = {mesh.positions[t.vertex[1]] - mesh.positions[t.vertex[0]],
                                      mesh.positions[t.vertex[2]] - mesh.positions[t.vertex[1]],
                                      mesh.positions[t.vertex[0]] - mesh.positions[t.vertex[2]]};
    const double twice = side[0].cross(side[1]).norm();
    double angle = std::numbers::pi, longest = 0;
    for (int k = 0; k < 3; ++k) {
      angle = std::min(angle, std::atan2(twice, -side[k].dot(side[(k + 1) % 3])));
      longest = std::max(longest, side[k].squaredNorm());
    }
    angles.push_back(kDegrees * angle);
    aspects.push_back(std::numbers::sqrt3 / 2 * longest / twice);
    area += twice;
    ++of_angle[std::min(static_cast<std::size_t>(angles.back() / 10), of_angle.size() - 1)];
    if (angles.back() < kSlim) {
      slim_area += twice;
      ++slim;
    }
  }
  quality.smallest_angle = *std::min_element(angles.begin(), angles.end());
  quality.median_angle = Quantile(angles, 0.5);
  const auto count = static_cast<double>(angles.size());
  quality.below_5_degrees = static_cast<double>(slim) / count;
  for (std::size_t i = 0; i < of_angle.size(); ++i)
    quality.angle_share[i] = static_cast<double>(of_angle[i]) / count;
  quality.slim_area = area > 0 ? slim_area / area : 0;
  quality.median_aspect = Quantile(aspects, 0.5);
  quality.aspect_p95 = Quantile(aspects, 0.95);
  return quality;
}

}  // namespace penumbra
