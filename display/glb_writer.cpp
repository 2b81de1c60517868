#include "display/glb_writer.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "display/glb_file.h"
#include "display/mesh_bytes.h"

namespace penumbra {
namespace {

// What each node has, as bytes.
struct NodeBytes {
  std::string positions, colours, irradiance, radiosity, indices;
  Eigen::Array3f least = Eigen::Array3f::Constant(INFINITY), most = -least;  // of the positions
};

// Positions are about the centre of the scene: floats keep their digits far from the origin.
NodeBytes BytesOf(const Scene& scene, const MeshNodes& nodes, const Vec3& centre, double exposure) {
  NodeBytes bytes;
  for (const MeshNodes::Node& node : nodes.nodes) {
    const Eigen::Array3f position = (node.position - centre).cast<float>().array();
    bytes.least = bytes.least.min(position);
    bytes.most = bytes.most.max(position);
    AppendTriple<float>(bytes.positions, position);
    AppendTriple<float>(bytes.colours, ExposedAt(scene, node, exposure));
    AppendTriple<float>(bytes.irradiance, node.irradiance);
    AppendTriple<float>(bytes.radiosity, node.radiosity);
  }
  for (const auto& six : nodes.triangles)
    for (const auto& triangle : Quarters(six))
      for (const std::uint32_t node : triangle) AppendBytes(bytes.indices, node);
  return bytes;
}

// The arrays of the nodes in one buffer, and the JSON that describes them.
class GlbBuffer {
 public:
  GlbBuffer(const NodeBytes& of, const MeshNodes& nodes) {
    constexpr int kArray = 34962, kElements = 34963, kFloat = 5126, kUint = 5125;
    const std::size_t count = nodes.nodes.size();
    Add(of.positions, kArray, kFloat, count, "VEC3",
        fmt::format(",\"min\":[{},{},{}],\"max\":[{},{},{}]", of.least[0], of.least[1], of.least[2],
                    of.most[0], of.most[1], of.most[2]));
    Add(of.colours, kArray, kFloat, count, "VEC3", "");
    Add(of.irradiance, kArray, kFloat, count, "VEC3", "");
    Add(of.radiosity, kArray, kFloat, count, "VEC3", "");
    Add(of.indices, kElements, kUint, 12 * nodes.triangles.size(), "SCALAR", "");
  }

  const std::string& bytes() const { return bytes_; }
  std::string Json() const {
    return fmt::format("\"accessors\":[{}],\"bufferViews\":[{}],\"buffers\":[{{\"byteLength\":{}}}]",
                       accessors_, views_, bytes_.size());
  }

 private:
  void Add(const std::string& bytes, int target, int type, std::size_t count, const char* shape,
           const std::string& more) {
    const char* comma = views_.empty() ? "" : ",";
    views_ += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{},\"target\":{}}}", comma,
                          bytes_.size(), bytes.size(), target);
    accessors_ += fmt::format("{}{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"{}}}",
                              comma, number_++, type, count, shape, more);
    bytes_ += bytes;
  }

  std::string bytes_, views_, accessors_;
  int number_ = 0;
};

// (x, y, z), z up, becomes (x, z, -y): a quarter turn about x.
std::string SceneJson(const Vec3& centre, double exposure) {
  constexpr double kHalf = 0.70710678118654752;
  return fmt::format(
      "\"scenes\":[{{\"nodes\":[0]}}],"
      "\"nodes\":[{{\"mesh\":0,\"rotation\":[{},0,0,{}],\"translation\":[{},{},{}]}}],"
      "\"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0,\"COLOR_0\":1,\"_IRRADIANCE\":2,"
      "\"_RADIOSITY\":3}},\"indices\":4,\"material\":0}}],\"extras\":{{\"exposure\":{}}}}}],"
      "\"materials\":[{{\"pbrMetallicRoughness\":{{\"baseColorFactor\":[1,1,1,1],\"metallicFactor\":0,"
      "\"roughnessFactor\":1}},\"extensions\":{{\"KHR_materials_unlit\":{{}}}}}}],",
      -kHalf, kHalf, centre.x(), centre.z(), -centre.y(), exposure);
}

std::string GlbBytes(const Scene& scene, const IrradianceMesh& mesh, double exposure) {
  const MeshNodes nodes = NodesToWrite(scene, mesh, std::numeric_limits<float>::max());
  std::string json =
      "{\"asset\":{\"version\":\"2.0\",\"generator\":\"penumbra\"},"
      "\"extensionsUsed\":[\"KHR_materials_unlit\"],\"scene\":0,";
  std::string buffer;
  if (nodes.nodes.empty()) {
    json += "\"scenes\":[{}]}";  // nothing may be empty but the scene
  } else {
    const auto [low, high] = scene.Bounds();
    const Vec3 centre = 0.5 * (low + high);
    const GlbBuffer arrays(BytesOf(scene, nodes, centre, exposure), nodes);
    json += SceneJson(centre, exposure) + arrays.Json() + "}";
    buffer = arrays.bytes();
  }
  return GlbFile(json, buffer);
}

class GlbWriter final : public MeshWriter {
 public:
  bool HasColours() const override { return true; }
  std::string Bytes(const MeshExport& from) const override {
    return GlbBytes(from.scene, from.mesh, ExposureOf(from));
  }
};

}  // namespace

MeshWriterRegistry::Method GlbWriterMethod() {
  return {
      "glb", "glTF 2.0: the same triangles, unlit, y up; _IRRADIANCE and _RADIOSITY as attributes", {}, [] {
        return std::make_unique<const GlbWriter>();
      }};
}

}  // namespace penumbra
