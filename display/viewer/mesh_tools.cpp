#include "display/viewer/mesh_tools.h"

#include <algorithm>

namespace penumbra::viewer {

std::array<Vec3, 3> TriangleVertices(const IrradianceMesh& mesh, std::uint32_t triangle) {
  const auto& at = mesh.triangles[triangle].vertex;
  return {mesh.positions[at[0]], mesh.positions[at[1]], mesh.positions[at[2]]};
}

double TriangleArea(const IrradianceMesh& mesh, std::uint32_t triangle) {
  return VectorArea(TriangleVertices(mesh, triangle)).norm();
}

Vec3 NormalOf(const Scene& scene, const IrradianceMesh& mesh, std::uint32_t triangle) {
  return scene.patches[static_cast<std::size_t>(mesh.triangles[triangle].patch)].normal;
}

Vec3 PointInTriangle(const IrradianceMesh& mesh, std::uint32_t triangle, double s, double t) {
  const auto v = TriangleVertices(mesh, triangle);
  return v[0] + s * (v[1] - v[0]) + t * (v[2] - v[0]);
}

ElementId LeafOf(const LightState& light, const IrradianceMesh& mesh, std::uint32_t triangle) {
  return light.solution().forest.LeafAt(mesh.triangles[triangle].patch,
                                        PointInTriangle(mesh, triangle, 1.0 / 3, 1.0 / 3));
}

bool IsBelow(const ElementForest& forest, ElementId element, ElementId top) {
  while (element != kNoElement && element != top) element = forest[element].parent;
  return element != kNoElement;
}

std::vector<std::uint32_t> TrianglesOf(const LightState& light, const IrradianceMesh& mesh,
                                       std::span<const ElementId> elements) {
  const ElementForest& forest = light.solution().forest;
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const PatchId patch = mesh.triangles[i].patch;
    ElementId leaf = kNoElement;
    for (const ElementId top : elements) {
      if (forest[top].patch != patch) continue;
      if (leaf == kNoElement) leaf = LeafOf(light, mesh, i);
      if (!IsBelow(forest, leaf, top)) continue;
      found.push_back(i);
      break;
    }
  }
  return found;
}

IrradianceMesh SubMesh(const IrradianceMesh& mesh, std::span<const std::uint32_t> triangles) {
  IrradianceMesh sub;
  sub.positions = mesh.positions;
  for (const std::uint32_t i : triangles) {
    sub.triangles.push_back(mesh.triangles[i]);
    sub.irradiance.push_back(mesh.irradiance[i]);
  }
  return sub;
}

Rgb ExactInTriangle(const LightState& light, const IrradianceMesh& mesh, std::uint32_t triangle, double s,
                    double t) {
  const PatchId patch = mesh.triangles[triangle].patch;
  ReceiverPoint at;
  at.position = PointInTriangle(mesh, triangle, s, t);
  at.normal = light.scene().patches[static_cast<std::size_t>(patch)].normal;
  at.approach = PointInTriangle(mesh, triangle, 1.0 / 3, 1.0 / 3) - at.position;
  return light.Exact().OnPatch(patch, at).irradiance;
}

}  // namespace penumbra::viewer
