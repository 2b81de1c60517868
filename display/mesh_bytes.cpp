#include "display/mesh_bytes.h"

#include <fmt/format.h>

#include "solver/base/check.h"

namespace penumbra {

MeshNodes NodesToWrite(const Scene& scene, const IrradianceMesh& mesh, double most) {
  MeshNodes nodes = FindMeshNodes(scene, mesh);
  for (const MeshNodes::Node& node : nodes.nodes)
    if (!(node.irradiance.abs().maxCoeff() <= most && node.radiosity.abs().maxCoeff() <= most) ||
        !node.irradiance.allFinite() || !node.radiosity.allFinite())
      throw InputError(fmt::format(
          "{}: error: the mesh holds a value that the format cannot, up to {:.2g}; give the scene less light",
          scene.name, most));
  return nodes;
}

double ExposureOf(const MeshExport& from) {
  return from.exposure ? *from.exposure : MeterMesh(from.scene, from.mesh);
}

Rgb ExposedAt(const Scene& scene, const MeshNodes::Node& node, double exposure) {
  if ((scene.MaterialOf(node.patch).emittance > 0).any()) return Rgb::Ones();
  return (exposure * node.radiosity).max(0.0).min(1.0);
}

}  // namespace penumbra
