#include "display/mesh_nodes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "display/tone_mapping.h"

namespace penumbra {
namespace {

// Where in kSampleAt the nodes stand: corners first, then edges.
constexpr std::array<std::size_t, 6> kSample = {0, 2, 4, 1, 3, 5};

class NodeList {
 public:
  NodeList(const Scene& scene, double tolerance, MeshNodes& out)
      : scene_(scene), tolerance_(tolerance), out_(out) {}

  // The node at a vertex (both equal) or between two of them.
  std::uint32_t Find(std::uint32_t a, std::uint32_t b, const Vec3& position, PatchId patch,
                     const Rgb& irradiance) {
    std::vector<std::uint32_t>& here = at_[std::minmax(a, b)];
    for (const std::uint32_t node : here)
      if (((out_.nodes[node].irradiance - irradiance).abs() <= tolerance_).all()) return node;
    const Material& material = scene_.MaterialOf(patch);
    here.push_back(static_cast<std::uint32_t>(out_.nodes.size()));
    out_.nodes.push_back(
        {position, irradiance, irradiance * material.reflectance + material.emittance, patch});
    return here.back();
  }

 private:
  const Scene& scene_;
  double tolerance_;  // [W/m^2]
  MeshNodes& out_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> at_;
};

double Largest(const IrradianceMesh& mesh) {
  double largest = 0;
  for (const QuadraticInterpolant& q : mesh.irradiance)
    for (const auto& [s, t] : kSampleAt) largest = std::max(largest, q.At(s, t).abs().maxCoeff());
  return largest;
}

}  // namespace

MeshNodes FindMeshNodes(const Scene& scene, const IrradianceMesh& mesh) {
  MeshNodes found;
  NodeList list(scene, kEqualIrradiance * Largest(mesh), found);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const IrradianceMesh::Triangle& triangle = mesh.triangles[i];
    std::array<std::uint32_t, 6> nodes;
    for (std::size_t k = 0; k < 6; ++k) {
      const std::uint32_t a = triangle.vertex[k % 3], b = k < 3 ? a : triangle.vertex[(k + 1) % 3];
      const auto& [s, t] = kSampleAt[kSample[k]];
      nodes[k] = list.Find(a, b, 0.5 * (mesh.positions[a] + mesh.positions[b]), triangle.patch,
                           mesh.irradiance[i].At(s, t));
    }
    found.triangles.push_back(nodes);
    const Vec3 centre = (mesh.positions[triangle.vertex[0]] + mesh.positions[triangle.vertex[1]] +
                         mesh.positions[triangle.vertex[2]]) /
                        3;
    found.face.push_back(scene.FaceAt(triangle.patch, centre));
  }
  return found;
}

std::array<std::array<std::uint32_t, 3>, 4> Quarters(const std::array<std::uint32_t, 6>& n) {
  return {{{n[0], n[3], n[5]}, {n[3], n[1], n[4]}, {n[5], n[4], n[2]}, {n[3], n[4], n[5]}}};
}

double MeterNodes(const Scene& scene, const IrradianceMesh& mesh, const MeshNodes& nodes) {
  std::vector<std::pair<double, double>> brightness;  // and the area that shows it
  double area = 0;
  for (std::size_t i = 0; i < nodes.triangles.size(); ++i) {
    const IrradianceMesh::Triangle& triangle = mesh.triangles[i];
    if ((scene.MaterialOf(triangle.patch).emittance > 0).any()) continue;
    const std::array<Vec3, 3> corners = {mesh.positions[triangle.vertex[0]],
                                         mesh.positions[triangle.vertex[1]],
                                         mesh.positions[triangle.vertex[2]]};
    const double sixth = VectorArea(corners).norm() / 6;
    for (const std::uint32_t node : nodes.triangles[i]) {
      brightness.emplace_back(nodes.nodes[node].radiosity.maxCoeff(), sixth);
      area += sixth;
    }
  }
  std::sort(brightness.begin(), brightness.end());
  double below = 0, metered = 0;
  for (const auto& [value, share] : brightness) {
    metered = value;
    below += share;
    if (below >= kMeteredFraction * area && value > 0) break;
  }
  const double exposure = kMeteredValue / metered;
  return metered > 0 && std::isfinite(exposure) ? exposure : 1;
}

double MeterMesh(const Scene& scene, const IrradianceMesh& mesh) {
  return MeterNodes(scene, mesh, FindMeshNodes(scene, mesh));
}

}  // namespace penumbra
