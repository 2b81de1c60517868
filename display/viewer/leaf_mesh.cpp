#include "display/viewer/leaf_mesh.h"

#include <unordered_map>

namespace penumbra::viewer {

IrradianceMesh LeafMesh(const ElementForest& forest, std::span<const Rgb> irradiance) {
  IrradianceMesh mesh;
  std::unordered_map<LatticePoint, std::uint32_t, LatticePointHash> vertices;
  for (std::size_t p = 0; p < forest.scene().patches.size(); ++p) {
    vertices.clear();
    for (const ElementId leaf : forest.Leaves(static_cast<PatchId>(p))) {
      const Element& element = forest[leaf];
      std::array<std::uint32_t, 4> at{};
      for (std::size_t k = 0; k < element.Corners().size(); ++k) {
        const auto [entry, added] =
            vertices.try_emplace(element.corner[k], static_cast<std::uint32_t>(mesh.positions.size()));
        if (added) mesh.positions.push_back(element.vertex[k]);
        at[k] = entry->second;
      }
      const auto light = QuadraticInterpolant::Constant(irradiance[static_cast<std::size_t>(leaf)]);
      for (std::size_t k = 2; k < element.Corners().size(); ++k) {
        IrradianceMesh::Triangle triangle;
        triangle.vertex = {at[0], at[k - 1], at[k]};
        triangle.patch = static_cast<PatchId>(p);
        mesh.triangles.push_back(triangle);
        mesh.irradiance.push_back(light);
      }
    }
  }
  return mesh;
}

}  // namespace penumbra::viewer
