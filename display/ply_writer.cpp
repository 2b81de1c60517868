#include "display/ply_writer.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "display/mesh_bytes.h"
#include "display/tone_mapping.h"

namespace penumbra {
namespace {

std::string PlyBytes(const Scene& scene, const IrradianceMesh& mesh, double exposure) {
  const MeshNodes nodes = NodesToWrite(scene, mesh, std::numeric_limits<float>::max());
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment irradiance and radiosity in W/m^2, lengths in metres\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property float irradiance_r\nproperty float irradiance_g\nproperty float irradiance_b\n"
      "property float radiosity_r\nproperty float radiosity_g\nproperty float radiosity_b\n"
      "element face {}\nproperty list uchar int vertex_indices\nproperty int patch\nend_header\n",
      nodes.nodes.size(), 4 * nodes.triangles.size());
  for (const MeshNodes::Node& node : nodes.nodes) {
    AppendTriple<double>(bytes, node.position);
    const Rgb shown = ExposedAt(scene, node, exposure);
    for (int c = 0; c < 3; ++c)
      bytes.push_back(static_cast<char>(std::lround(255 * SrgbFromLinear(shown[c]))));
    AppendTriple<float>(bytes, node.irradiance);
    AppendTriple<float>(bytes, node.radiosity);
  }
  for (std::size_t i = 0; i < nodes.triangles.size(); ++i)
    for (const auto& triangle : Quarters(nodes.triangles[i])) {
      bytes.push_back(3);
      for (const std::uint32_t node : triangle) AppendBytes(bytes, static_cast<std::int32_t>(node));
      AppendBytes(bytes, nodes.face[i]);
    }
  return bytes;
}

class PlyWriter final : public MeshWriter {
 public:
  bool HasColours() const override { return true; }
  std::string Bytes(const MeshExport& from) const override {
    return PlyBytes(from.scene, from.mesh, ExposureOf(from));
  }
};

}  // namespace

MeshWriterRegistry::Method PlyWriterMethod() {
  return {"ply",
          "binary: vertices with irradiance, radiosity [W/m^2] and colours; four triangles for each",
          {},
          [] { return std::make_unique<const PlyWriter>(); }};
}

}  // namespace penumbra
