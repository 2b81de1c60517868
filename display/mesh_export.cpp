#include "display/mesh_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "display/mesh_nodes.h"
#include "display/tone_mapping.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

static_assert(std::endian::native == std::endian::little, "all three formats are written little-endian");

template <class T>
void Append(std::string& bytes, const T& value) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof(T));
  bytes.append(raw.data(), raw.size());
}

template <class Scalar>
void AppendTriple(std::string& bytes, const auto& triple) {
  for (int i = 0; i < 3; ++i) Append(bytes, static_cast<Scalar>(triple[i]));
}

std::string Base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(4 * bytes.size() / 3 + 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t word = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    for (std::size_t i = 0; i < 3; ++i)
      word = word << 8 | (i < count ? static_cast<unsigned char>(bytes[at + i]) : 0U);
    for (std::size_t i = 0; i < 4; ++i) text.push_back(i <= count ? kDigits[word >> (18 - 6 * i) & 63] : '=');
  }
  return text;
}

// One array of a VTU file: its length in bytes and itself.
std::string DataArray(const char* type, const char* name, int components, const std::string& bytes) {
  std::string raw;
  Append(raw, static_cast<std::uint64_t>(bytes.size()));
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n", type,
      name, components, Base64(raw + bytes));
}

// The nodes, for a file whose values have `Scalar`s. Throws InputError if one does not fit.
template <class Scalar>
MeshNodes NodesToWrite(const Scene& scene, const IrradianceMesh& mesh) {
  MeshNodes nodes = FindMeshNodes(scene, mesh);
  constexpr double kMost = std::numeric_limits<Scalar>::max();
  for (const MeshNodes::Node& node : nodes.nodes)
    if (!(node.irradiance.abs().maxCoeff() <= kMost && node.radiosity.abs().maxCoeff() <= kMost) ||
        !node.irradiance.allFinite() || !node.radiosity.allFinite())
      throw InputError(fmt::format(
          "{}: error: the mesh holds a value that the format cannot, up to {:.2g}; give the scene less light",
          scene.name, kMost));
  return nodes;
}

// What a screen shows of a node, linear.
Rgb ExposedAt(const Scene& scene, const MeshNodes::Node& node, double exposure) {
  if ((scene.MaterialOf(node.patch).emittance > 0).any()) return Rgb::Ones();
  return (exposure * node.radiosity).max(0.0).min(1.0);
}

constexpr int kQuadraticTriangle = 22;  // VTK_QUADRATIC_TRIANGLE

// The chunk of a GLB file, filled up to a multiple of four bytes.
std::string Chunk(std::uint32_t type, std::string bytes, char filler) {
  bytes.append((4 - bytes.size() % 4) % 4, filler);
  std::string chunk;
  Append(chunk, static_cast<std::uint32_t>(bytes.size()));
  Append(chunk, type);
  return chunk + bytes;
}

}  // namespace

std::string VtuBytes(const Scene& scene, const IrradianceMesh& mesh) {
  const MeshNodes nodes = NodesToWrite<double>(scene, mesh);
  std::string points, irradiance, radiosity, connectivity, offsets, types, patches;
  for (const MeshNodes::Node& node : nodes.nodes) {
    AppendTriple<double>(points, node.position);
    AppendTriple<double>(irradiance, node.irradiance);
    AppendTriple<double>(radiosity, node.radiosity);
  }
  for (std::size_t i = 0; i < nodes.triangles.size(); ++i) {
    for (const std::uint32_t node : nodes.triangles[i]) Append(connectivity, static_cast<std::int64_t>(node));
    Append(offsets, static_cast<std::int64_t>(6 * (i + 1)));
    types.push_back(static_cast<char>(kQuadraticTriangle));
    Append(patches, nodes.face[i]);
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

std::string PlyBytes(const Scene& scene, const IrradianceMesh& mesh, double exposure) {
  const MeshNodes nodes = NodesToWrite<float>(scene, mesh);
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
      for (const std::uint32_t node : triangle) Append(bytes, static_cast<std::int32_t>(node));
      Append(bytes, nodes.face[i]);
    }
  return bytes;
}

namespace {

// Numbers of OpenGL that glTF takes over.
constexpr int kGlArray = 34962, kGlElements = 34963, kGlFloat = 5126, kGlUint = 5125;

// The binary buffer of a glTF file, and the parts of it that its JSON names.
struct GlbBuffer {
  std::string bytes, views, accessors;
  std::size_t parts = 0;

  // Adds a part of `count` elements; `more` is further JSON of its accessor.
  void Add(const std::string& part, int target, int type, std::size_t count, const char* shape,
           const std::string& more) {
    const char* comma = parts == 0 ? "" : ",";
    views += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{},\"target\":{}}}", comma,
                         bytes.size(), part.size(), target);
    accessors += fmt::format("{}{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"{}}}",
                             comma, parts, type, count, shape, more);
    bytes += part;
    ++parts;
  }
};

// Positions relative to `centre`, colours, irradiance and radiosity of the nodes, and the triangles.
GlbBuffer FillGlbBuffer(const Scene& scene, const MeshNodes& nodes, const Vec3& centre, double exposure) {
  std::string positions, colours, irradiance, radiosity, indices;
  Eigen::Array3f least = Eigen::Array3f::Constant(INFINITY), most = -least;
  for (const MeshNodes::Node& node : nodes.nodes) {
    const Eigen::Array3f position = (node.position - centre).cast<float>().array();
    least = least.min(position);
    most = most.max(position);
    AppendTriple<float>(positions, position);
    AppendTriple<float>(colours, ExposedAt(scene, node, exposure));
    AppendTriple<float>(irradiance, node.irradiance);
    AppendTriple<float>(radiosity, node.radiosity);
  }
  for (const auto& six : nodes.triangles)
    for (const auto& triangle : Quarters(six))
      for (const std::uint32_t node : triangle) Append(indices, node);
  GlbBuffer buffer;
  const std::size_t count = nodes.nodes.size();
  buffer.Add(positions, kGlArray, kGlFloat, count, "VEC3",
             fmt::format(",\"min\":[{},{},{}],\"max\":[{},{},{}]", least[0], least[1], least[2], most[0],
                         most[1], most[2]));
  buffer.Add(colours, kGlArray, kGlFloat, count, "VEC3", "");
  buffer.Add(irradiance, kGlArray, kGlFloat, count, "VEC3", "");
  buffer.Add(radiosity, kGlArray, kGlFloat, count, "VEC3", "");
  buffer.Add(indices, kGlElements, kGlUint, 12 * nodes.triangles.size(), "SCALAR", "");
  return buffer;
}

// Everything in the JSON but the asset itself.
std::string GlbScene(const GlbBuffer& buffer, const Vec3& centre, double exposure) {
  // (x, y, z), z up, becomes (x, z, -y): a quarter turn about x.
  constexpr double kHalf = 0.70710678118654752;
  return fmt::format(
      "\"scenes\":[{{\"nodes\":[0]}}],"
      "\"nodes\":[{{\"mesh\":0,\"rotation\":[{},0,0,{}],\"translation\":[{},{},{}]}}],"
      "\"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0,\"COLOR_0\":1,\"_IRRADIANCE\":2,"
      "\"_RADIOSITY\":3}},\"indices\":4,\"material\":0}}],\"extras\":{{\"exposure\":{}}}}}],"
      "\"materials\":[{{\"pbrMetallicRoughness\":{{\"baseColorFactor\":[1,1,1,1],\"metallicFactor\":0,"
      "\"roughnessFactor\":1}},\"extensions\":{{\"KHR_materials_unlit\":{{}}}}}}],"
      "\"accessors\":[{}],\"bufferViews\":[{}],\"buffers\":[{{\"byteLength\":{}}}]}}",
      -kHalf, kHalf, centre.x(), centre.z(), -centre.y(), exposure, buffer.accessors, buffer.views,
      buffer.bytes.size());
}

}  // namespace

std::string GlbBytes(const Scene& scene, const IrradianceMesh& mesh, double exposure) {
  const MeshNodes nodes = NodesToWrite<float>(scene, mesh);
  std::string json =
      "{\"asset\":{\"version\":\"2.0\",\"generator\":\"penumbra\"},"
      "\"extensionsUsed\":[\"KHR_materials_unlit\"],\"scene\":0,";
  GlbBuffer buffer;
  if (nodes.nodes.empty()) {
    json += "\"scenes\":[{}]}";  // nothing may be empty but the scene
  } else {
    // Floats about the centre of the scene keep their digits far from the origin.
    const auto [low, high] = scene.Bounds();
    const Vec3 centre = 0.5 * (low + high);
    buffer = FillGlbBuffer(scene, nodes, centre, exposure);
    json += GlbScene(buffer, centre, exposure);
  }
  constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942, kVersion = 2;
  std::string chunks = Chunk(kJsonChunk, json, ' ');
  if (!buffer.bytes.empty()) chunks += Chunk(kBinaryChunk, buffer.bytes, '\0');
  std::string bytes = "glTF";
  Append(bytes, kVersion);
  Append(bytes, static_cast<std::uint32_t>(12 + chunks.size()));
  return bytes + chunks;
}

double MeterMesh(const Scene& scene, const IrradianceMesh& mesh) {
  return MeterNodes(scene, mesh, FindMeshNodes(scene, mesh));
}

}  // namespace penumbra
