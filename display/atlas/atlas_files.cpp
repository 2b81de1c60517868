#include "display/atlas/atlas_files.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "display/glb_file.h"
#include "display/image_writers.h"
#include "display/mesh_bytes.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

using nlohmann::ordered_json;

// One buffer, and the JSON of its parts.
class AtlasBuffer {
 public:
  // A part of the buffer; `target` 0: no vertices and no indices.
  int AddView(const std::string& bytes, int target) {
    ordered_json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}};
    if (target != 0) view["target"] = target;
    views_.push_back(view);
    bytes_ += bytes;
    bytes_.append((4 - bytes_.size() % 4) % 4, '\0');
    return static_cast<int>(views_.size()) - 1;
  }
  void AddAccessor(int view, int type, std::size_t count, const char* shape, const ordered_json& more) {
    ordered_json accessor = {
        {"bufferView", view}, {"componentType", type}, {"count", count}, {"type", shape}};
    accessor.update(more);
    accessors_.push_back(accessor);
  }
  void Describe(ordered_json* gltf) const {
    (*gltf)["accessors"] = accessors_;
    (*gltf)["bufferViews"] = views_;
    (*gltf)["buffers"] = ordered_json::array({ordered_json{{"byteLength", bytes_.size()}}});
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  ordered_json views_ = ordered_json::array(), accessors_ = ordered_json::array();
};

// Adds the corners of all polygons, their places on the map, and the triangles of each polygon.
void AddPolygons(const LightAtlas& atlas, const Vec3& centre, AtlasBuffer* buffer) {
  constexpr int kArray = 34962, kElements = 34963, kFloat = 5126, kUint = 5125;
  std::string positions, places, indices;
  Eigen::Array3f least = Eigen::Array3f::Constant(INFINITY), most = -least;
  std::uint32_t corners = 0;
  std::size_t index_count = 0;
  for (const AtlasPolygon& polygon : atlas.polygons) {
    for (const Vec3& corner : polygon.corners) {
      const Eigen::Array3f position = (corner - centre).cast<float>().array();
      least = least.min(position);
      most = most.max(position);
      AppendTriple<float>(positions, position);
    }
    for (const Vec2& pixel : polygon.places)
      for (int i = 0; i < 2; ++i) AppendBytes(places, static_cast<float>(pixel[i] / atlas.irradiance.width));
    for (const std::array<std::int32_t, 3>& triangle : polygon.triangles) {
      for (const std::int32_t corner : triangle)
        AppendBytes(indices, corners + static_cast<std::uint32_t>(corner));
      index_count += 3;
    }
    corners += static_cast<std::uint32_t>(polygon.corners.size());
  }
  buffer->AddAccessor(buffer->AddView(positions, kArray), kFloat, corners, "VEC3",
                      {{"min", {least[0], least[1], least[2]}}, {"max", {most[0], most[1], most[2]}}});
  buffer->AddAccessor(buffer->AddView(places, kArray), kFloat, corners, "VEC2", ordered_json::object());
  buffer->AddAccessor(buffer->AddView(indices, kElements), kUint, index_count, "SCALAR",
                      ordered_json::object());
}

std::string AtlasGlb(const MeshExport& from, const LightAtlas& atlas, double exposure) {
  ordered_json gltf = {{"asset", {{"version", "2.0"}, {"generator", "penumbra"}}}, {"scene", 0}};
  if (from.scene.patches.empty()) {
    gltf["scenes"] = ordered_json::array({ordered_json::object()});  // nothing may be empty but the scene
    return GlbFile(gltf.dump(), "");
  }
  const auto [low, high] = from.scene.Bounds();
  const Vec3 centre = 0.5 * (low + high);  // floats keep their digits far from the origin
  AtlasBuffer buffer;
  AddPolygons(atlas, centre, &buffer);
  const int image =
      buffer.AddView(ImageWriters().Make("png")->Bytes(RadiosityOnScreen(from.scene, atlas, exposure)), 0);
  constexpr int kLinear = 9729, kClamp = 33071;
  constexpr double kHalf =
      0.70710678118654752;  // a quarter turn about x: (x, y, z), z up, becomes (x, z, -y)
  const auto list = [](const ordered_json& only) { return ordered_json::array({only}); };
  gltf["extensionsUsed"] = list("KHR_materials_unlit");
  gltf["scenes"] = list({{"nodes", list(0)}});
  gltf["nodes"] = list({{"mesh", 0},
                        {"rotation", {-kHalf, 0, 0, kHalf}},
                        {"translation", {centre.x(), centre.z(), -centre.y()}}});
  const ordered_json primitive = {{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}, {"TEXCOORD_1", 1}}},
                                  {"indices", 2},
                                  {"material", 0}};
  gltf["meshes"] = list({{"primitives", list(primitive)}, {"extras", {{"exposure", exposure}}}});
  const ordered_json wears = {
      {"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}, {"roughnessFactor", 1}};
  gltf["materials"] = list(
      {{"pbrMetallicRoughness", wears}, {"extensions", {{"KHR_materials_unlit", ordered_json::object()}}}});
  gltf["textures"] = list({{"source", 0}, {"sampler", 0}});
  gltf["samplers"] =
      list({{"magFilter", kLinear}, {"minFilter", kLinear}, {"wrapS", kClamp}, {"wrapT", kClamp}});
  gltf["images"] = list({{"bufferView", image}, {"mimeType", "image/png"}});
  buffer.Describe(&gltf);
  return GlbFile(gltf.dump(), buffer.bytes());
}

}  // namespace

std::vector<std::string> AtlasEndings() { return {"exr", "png", "glb"}; }

std::string AtlasBytes(const std::string& ending, const MeshExport& from, int size, AtlasPlaces places) {
  const double exposure = ExposureOf(from);
  const LightAtlas atlas = MakeLightAtlas(from.scene, from.mesh, size, places);
  for (const std::vector<float>& plane : atlas.irradiance.channel)
    for (const float value : plane)
      if (!std::isfinite(value))
        throw InputError(from.scene.name +
                         ": error: the map holds a value that floats cannot; give the scene less light");
  if (ending == "glb") return AtlasGlb(from, atlas, exposure);
  if (ending == "png") return ImageWriters().Make("png")->Bytes(IrradianceOnScreen(atlas, exposure));
  PENUMBRA_CHECK(ending == "exr");
  return ImageWriters().Make("exr")->Bytes(atlas.irradiance);
}

}  // namespace penumbra
