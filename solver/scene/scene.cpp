#include "solver/scene/scene.h"

#include <algorithm>
#include <limits>

#include "solver/base/check.h"

namespace penumbra {

Patch MakePatch(std::span<const Vec3> vertices, std::int32_t material, std::int32_t object,
                std::vector<std::int32_t> faces) {
  PENUMBRA_CHECK(vertices.size() == 3 || vertices.size() == 4);
  Patch patch;
  patch.size = static_cast<std::int32_t>(vertices.size());
  std::copy(vertices.begin(), vertices.end(), patch.vertex.begin());
  if (patch.size == 3) patch.vertex[3] = patch.vertex[2];
  const Vec3 area = VectorArea(vertices);
  patch.area = area.norm();
  PENUMBRA_CHECK(patch.area > 0);
  patch.normal = area / patch.area;
  for (const Vec3& v : vertices) patch.extent = std::max(patch.extent, MaxAbs(v));
  patch.material = material;
  patch.object = object;
  patch.faces = std::move(faces);
  std::sort(patch.faces.begin(), patch.faces.end());
  return patch;
}

std::int32_t Scene::FaceAt(PatchId patch, const Vec3& p) const {
  const Patch& at = patches[patch];
  if (at.faces.size() == 1) return at.faces.front();
  // A joined patch is covered by two triangles; what lies outside both by rounding belongs to the nearer.
  constexpr double kRounding = 1e-12;
  std::int32_t nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t face : at.faces) {
    const Polygon3& polygon = faces[face].vertices;
    double outside = kRounding * Diameter(polygon);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 edge = (polygon[(i + 1) % polygon.size()] - polygon[i]).normalized();
      outside = std::max(outside, -at.normal.cross(edge).dot(p - polygon[i]));
    }
    if (outside <= kRounding * Diameter(polygon)) return face;
    if (outside < least) {
      least = outside;
      nearest = face;
    }
  }
  return nearest;
}

std::pair<Vec3, Vec3> Scene::Bounds() const {
  if (patches.empty()) return {Vec3::Zero(), Vec3::Zero()};
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Patch& patch : patches)
    for (const Vec3& v : patch.Vertices()) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
  return {low, high};
}

double Scene::Diagonal() const {
  const auto [low, high] = Bounds();
  return (high - low).norm();
}

}  // namespace penumbra
