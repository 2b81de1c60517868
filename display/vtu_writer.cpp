#include "display/vtu_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>

#include "display/base64.h"
#include "display/mesh_bytes.h"

namespace penumbra {
namespace {

// One array of a VTU file: its length in bytes and itself.
std::string DataArray(const char* type, const char* name, int components, const std::string& bytes) {
  std::string raw;
  AppendBytes(raw, static_cast<std::uint64_t>(bytes.size()));
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n", type,
      name, components, Base64(raw + bytes));
}

constexpr int kQuadraticTriangle = 22;  // VTK_QUADRATIC_TRIANGLE

std::string VtuBytes(const Scene& scene, const IrradianceMesh& mesh) {
  const MeshNodes nodes = NodesToWrite(scene, mesh, std::numeric_limits<double>::max());
  std::string points, irradiance, radiosity, connectivity, offsets, types, patches;
  for (const MeshNodes::Node& node : nodes.nodes) {
    AppendTriple<double>(points, node.position);
    AppendTriple<double>(irradiance, node.irradiance);
    AppendTriple<double>(radiosity, node.radiosity);
  }
  for (std::size_t i = 0; i < nodes.triangles.size(); ++i) {
    for (const std::uint32_t node : nodes.triangles[i])
      AppendBytes(connectivity, static_cast<std::int64_t>(node));
    AppendBytes(offsets, static_cast<std::int64_t>(6 * (i + 1)));
    types.push_back(static_cast<char>(kQuadraticTriangle));
    AppendBytes(patches, nodes.face[i]);
  }
  return fmt::format(
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
             "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
             "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
             nodes.nodes.size(), nodes.triangles.size()) +
         "<Points>\n" + DataArray("Float64", "Points", 3, points) + "</Points>\n<Cells>\n" +
         DataArray("Int64", "connectivity", 1, connectivity) + DataArray("Int64", "offsets", 1, offsets) +
         DataArray("UInt8", "types", 1, types) + "</Cells>\n<PointData Vectors=\"irradiance\">\n" +
         DataArray("Float64", "irradiance", 3, irradiance) + DataArray("Float64", "radiosity", 3, radiosity) +
         "</PointData>\n<CellData Scalars=\"patch\">\n" + DataArray("Int32", "patch", 1, patches) +
         "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

class VtuWriter final : public MeshWriter {
 public:
  bool HasColours() const override { return false; }
  std::string Bytes(const MeshExport& from) const override { return VtuBytes(from.scene, from.mesh); }
};

}  // namespace

MeshWriterRegistry::Method VtuWriterMethod() {
  return {"vtu",
          "VTK, ParaView: quadratic triangles, the interpolants themselves; irradiance, radiosity, patch",
          {},
          [] { return std::make_unique<const VtuWriter>(); }};
}

}  // namespace penumbra
