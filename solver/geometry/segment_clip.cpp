#include "solver/geometry/segment_clip.h"

namespace penumbra {

std::optional<std::array<Vec3, 2>> ClipToPolygon(const Vec3& a, const Vec3& b, std::span<const Vec3> polygon,
                                                 const Vec3& normal, double tolerance) {
  SegmentClip clip;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 edge = polygon[(k + 1) % polygon.size()] - polygon[k];
    const double length = edge.norm();
    if (length == 0) continue;
    const Vec3 inward = normal.cross(edge) / length;
    clip.Keep(inward.dot(a - polygon[k]) + tolerance, inward.dot(b - polygon[k]) + tolerance);
  }
  if (clip.Empty()) return std::nullopt;
  return std::array<Vec3, 2>{Between(a, b, clip.t0), Between(a, b, clip.t1)};
}

}  // namespace penumbra
