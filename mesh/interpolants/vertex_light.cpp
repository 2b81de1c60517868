#include "mesh/interpolants/vertex_light.h"

#include "solver/base/parallel.h"

namespace penumbra {
namespace {

Vec3 MeanOfVertices(const Element& element) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& vertex : element.Vertices()) sum += vertex;
  return sum / element.size;
}

struct SharedVertex {
  PatchId patch = kNoPatch;
  LatticePoint at;
  ReceiverPoint point;
};

}  // namespace

std::vector<VertexLight> NodalAverages(const ElementForest& forest, std::span<const Rgb> irradiance) {
  std::vector<VertexLight> light(forest.scene().patches.size());
  for (std::size_t p = 0; p < light.size(); ++p) {
    std::unordered_map<LatticePoint, int, LatticePointHash> sharing;
    for (const ElementId leaf : forest.Leaves(static_cast<PatchId>(p)))
      for (const LatticePoint& corner : forest[leaf].Corners()) {
        const Rgb& value = irradiance[static_cast<std::size_t>(leaf)];
        const int count = ++sharing[corner];
        Rgb& mean = light[p].try_emplace(corner, Rgb::Zero()).first->second;
        mean += (value - mean) / count;
      }
  }
  return light;
}

std::vector<VertexLight> ExactAtVertices(const ElementForest& forest, const PointIrradiance& irradiance,
                                         const ExecutionContext& context) {
  std::vector<VertexLight> light(forest.scene().patches.size());
  std::vector<SharedVertex> vertices;
  for (std::size_t p = 0; p < light.size(); ++p)
    for (const ElementId leaf : forest.Leaves(static_cast<PatchId>(p))) {
      const Element& element = forest[leaf];
      const Vec3 centre = MeanOfVertices(element);
      for (std::size_t k = 0; k < element.Corners().size(); ++k) {
        if (!light[p].try_emplace(element.corner[k], Rgb::Zero()).second) continue;
        const Vec3& position = element.vertex[k];
        vertices.push_back({static_cast<PatchId>(p),
                            element.corner[k],
                            {position, forest.scene().patches[p].normal, centre - position}});
      }
    }
  std::vector<Rgb> values(vertices.size(), Rgb::Zero());
  ParallelFor(vertices.size(), 16, [&](std::size_t i) {
    if (!context.Cancelled()) values[i] = irradiance.OnPatch(vertices[i].patch, vertices[i].point).irradiance;
  });
  for (std::size_t i = 0; i < vertices.size(); ++i)
    light[static_cast<std::size_t>(vertices[i].patch)][vertices[i].at] = values[i];
  return light;
}

Rgb BilinearAt(const Element& leaf, const VertexLight& light, double s, double t) {
  const auto corner = [&](std::size_t k) -> const Rgb& { return light.at(leaf.corner[k]); };
  if (leaf.size == 3) return (1 - s - t) * corner(0) + s * corner(1) + t * corner(2);
  return (1 - t) * ((1 - s) * corner(0) + s * corner(1)) + t * ((1 - s) * corner(3) + s * corner(2));
}

}  // namespace penumbra
