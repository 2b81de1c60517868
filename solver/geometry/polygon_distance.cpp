#include "solver/geometry/polygon_distance.h"

#include <algorithm>
#include <cmath>

#include "solver/geometry/polygon.h"

namespace penumbra {

namespace {

Vec3 NearestInSegment(const Vec3& x, const Vec3& p, const Vec3& q) {
  const Vec3 along = q - p;
  const double square = along.squaredNorm();
  const double t = square > 0 ? std::clamp((x - p).dot(along) / square, 0.0, 1.0) : 0.0;
  return p + t * along;
}

}  // namespace

double DistanceToSegment(const Vec3& x, const Vec3& p, const Vec3& q) {
  return (x - NearestInSegment(x, p, q)).norm();
}

Vec3 NearestInPolygon(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& x) {
  const Vec3 foot = x - normal.dot(x - polygon[0]) * normal;
  if (ConvexContains(polygon, normal, foot, 0)) return foot;
  Vec3 nearest = polygon[0];
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 on_edge = NearestInSegment(x, polygon[k], polygon[(k + 1) % polygon.size()]);
    if ((x - on_edge).squaredNorm() < (x - nearest).squaredNorm()) nearest = on_edge;
  }
  return nearest;
}

double DistanceToPolygon(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& x) {
  return (x - NearestInPolygon(polygon, normal, x)).norm();
}

}  // namespace penumbra
