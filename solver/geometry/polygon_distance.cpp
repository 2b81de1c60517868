#include "solver/geometry/polygon_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/geometry/polygon.h"

namespace penumbra {

double DistanceToSegment(const Vec3& x, const Vec3& p, const Vec3& q) {
  const Vec3 along = q - p;
  const double square = along.squaredNorm();
  const double t = square > 0 ? std::clamp((x - p).dot(along) / square, 0.0, 1.0) : 0.0;
  return (x - p - t * along).norm();
}

double DistanceToPolygon(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& x) {
  const double height = normal.dot(x - polygon[0]);
  if (ConvexContains(polygon, normal, x - height * normal, 0)) return std::abs(height);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < polygon.size(); ++k)
    nearest = std::min(nearest, DistanceToSegment(x, polygon[k], polygon[(k + 1) % polygon.size()]));
  return nearest;
}

}  // namespace penumbra
