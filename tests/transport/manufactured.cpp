#include "tests/transport/manufactured.h"

#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/transport/links/cubature.h"
#include "solver/transport/solvers/dense_system.h"
#include "solver/transport/sources/source_quadrature.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {

Rgb FieldIrradiance(const Scene& scene, const PatchVisibility& visibility, const RadiosityField& field,
                    PatchId patch, const ReceiverPoint& at) {
  PointView view(scene, at);
  std::vector<SourceNode> nodes;
  Rgb irradiance = Rgb::Zero();
  for (const PatchPair& pair : visibility.SourcesOf(patch)) {
    if (!view.FaceSource(pair.source)) continue;
    nodes.clear();
    AddVisibleSourceNodes(view, scene.patches[pair.source].Vertices(), visibility.Blockers(pair), patch,
                          nodes);
    for (const SourceNode& node : nodes) irradiance += node.weight * field(pair.source, node.position);
  }
  return irradiance;
}

Rgb ManufacturedEmittance(const Scene& scene, const PatchVisibility& visibility, const RadiosityField& field,
                          PatchId patch, const Vec3& position) {
  ReceiverPoint at;
  at.position = position;
  at.normal = scene.patches[patch].normal;
  return field(patch, position) -
         scene.MaterialOf(patch).reflectance * FieldIrradiance(scene, visibility, field, patch, at);
}

Scene ManufacturedScene(const Scene& scene, const PatchVisibility& visibility, const RadiosityField& field,
                        int divisions) {
  const ElementForest forest = UniformForest(scene, divisions);
  const std::vector<ElementId> leaves = forest.AllLeaves();
  std::vector<Rgb> emittance(leaves.size(), Rgb::Zero());
  ParallelFor(leaves.size(), 1, [&](std::size_t i) {
    const Element& leaf = forest[leaves[i]];
    for (const CubaturePoint& point : Cubature(leaf.Vertices(), 1))
      emittance[i] +=
          point.weight * ManufacturedEmittance(scene, visibility, field, leaf.patch, point.position);
  });
  Scene tiled = scene;
  tiled.patches.clear();
  tiled.materials.clear();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    PENUMBRA_CHECK((emittance[i] >= 0).all());
    const Element& leaf = forest[leaves[i]];
    const Patch& patch = scene.patches[leaf.patch];
    Material material = scene.MaterialOf(leaf.patch);
    material.emittance = emittance[i];
    tiled.patches.push_back(MakePatch(leaf.Vertices(), static_cast<std::int32_t>(tiled.materials.size()),
                                      patch.object, patch.faces));
    tiled.materials.push_back(std::move(material));
  }
  return tiled;
}

}  // namespace penumbra
