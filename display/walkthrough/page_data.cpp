#include "display/walkthrough/page_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "display/false_colour.h"
#include "display/mesh_bytes.h"
#include "display/tone_mapping.h"

namespace penumbra {
namespace {

using nlohmann::ordered_json;

ordered_json Triple(const auto& v) { return {v[0], v[1], v[2]}; }

bool SameView(const Camera& a, const Camera& b) {
  return a.eye == b.eye && a.look_at == b.look_at && a.up == b.up && a.vertical_fov == b.vertical_fov;
}

// The scene's cameras, and the one where the page begins; `first` is its place among them.
ordered_json CameraList(const MeshExport& from, std::size_t* first) {
  std::vector<Camera> cameras = from.scene.cameras;
  const auto same = std::find_if(cameras.begin(), cameras.end(),
                                 [&from](const Camera& camera) { return SameView(camera, from.camera); });
  *first = static_cast<std::size_t>(same - cameras.begin());
  if (same == cameras.end()) {
    cameras.push_back(from.camera);
    const bool taken = std::any_of(cameras.begin(), cameras.end() - 1,
                                   [&from](const Camera& camera) { return camera.name == from.camera.name; });
    if (taken || from.camera.name.empty()) cameras.back().name = "start";
  }
  ordered_json list = ordered_json::array();
  for (const Camera& camera : cameras)
    list.push_back({{"name", camera.name},
                    {"eye", Triple(camera.eye)},
                    {"lookAt", Triple(camera.look_at)},
                    {"up", Triple(camera.up)},
                    {"fov", camera.vertical_fov}});
  return list;
}

ordered_json MaterialList(const Scene& scene) {
  ordered_json list = ordered_json::array();
  for (const Material& material : scene.materials)
    list.push_back({{"name", material.name},
                    {"reflectance", Triple(material.reflectance)},
                    {"emittance", Triple(material.emittance)}});
  return list;
}

// Triangles that follow one another and share face, material and object are told together.
ordered_json RunList(const Scene& scene, const IrradianceMesh& mesh, const MeshNodes& nodes) {
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0, begin = 0; i < nodes.face.size(); ++i) {
    const bool ends = i + 1 == nodes.face.size() || nodes.face[i + 1] != nodes.face[i] ||
                      mesh.triangles[i + 1].patch != mesh.triangles[i].patch;
    if (!ends) continue;
    const Patch& patch = scene.patches[static_cast<std::size_t>(mesh.triangles[i].patch)];
    list.push_back({{"count", i + 1 - begin},
                    {"patch", nodes.face[i]},
                    {"material", patch.material},
                    {"object", patch.object}});
    begin = i + 1;
  }
  return list;
}

ordered_json ScaleList() {
  ordered_json list = ordered_json::array();
  for (int i = 0; i < kFalseColourStops; ++i) {
    const ScreenColour colour = FalseColour(static_cast<double>(i) / (kFalseColourStops - 1));
    list.push_back({colour.red, colour.green, colour.blue});
  }
  return list;
}

std::string Description(const MeshExport& from, const MeshNodes& nodes, const Vec3& centre) {
  const Scene& scene = from.scene;
  const auto [low, high] = scene.Bounds();
  const long background = std::lround(255 * SrgbFromLinear(static_cast<double>(kBackground)));
  std::size_t first = 0;
  ordered_json all;
  all["title"] = scene.name;
  all["vertexCount"] = from.mesh.positions.size();
  all["triangleCount"] = from.mesh.triangles.size();
  all["centre"] = Triple(centre);
  all["bounds"] = {{"min", Triple(low)}, {"max", Triple(high)}};
  all["cameras"] = CameraList(from, &first);
  all["firstCamera"] = first;
  all["exposure"] = from.exposure ? *from.exposure : MeterNodes(scene, from.mesh, nodes);
  all["metered"] = !from.exposure;
  all["meteredFraction"] = kMeteredFraction;
  all["meteredValue"] = kMeteredValue;
  all["background"] = {background, background, background};
  all["scale"] = ScaleList();
  all["materials"] = MaterialList(scene);
  all["objects"] = ordered_json::array();
  for (const Object& object : scene.objects) all["objects"].push_back(object.name);
  all["runs"] = RunList(scene, from.mesh, nodes);
  // Names come from files and may be anything; in the text of a page `<` could end the script.
  std::string text = all.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  return text;
}

// Appends the scale of a triangle, and its samples in that unit.
void AppendSamples(const MeshNodes& nodes, const std::array<std::uint32_t, 6>& six, std::string* scales,
                   std::string* samples) {
  double largest = 0;
  for (const std::uint32_t node : six)
    largest = std::max(largest, nodes.nodes[node].irradiance.abs().maxCoeff());
  // The unit is rounded upwards, so that no sample exceeds its type.
  float unit = static_cast<float>(largest / kLargestSample);
  if (static_cast<double>(unit) * kLargestSample < largest)
    unit = std::nextafter(unit, std::numeric_limits<float>::max());
  AppendBytes(*scales, unit);
  for (const std::uint32_t node : six)
    for (int c = 0; c < 3; ++c) {
      const double value = unit > 0 ? nodes.nodes[node].irradiance[c] / static_cast<double>(unit) : 0;
      AppendBytes(*samples, static_cast<std::int16_t>(std::lround(value)));
    }
}

}  // namespace

PageData MakePageData(const MeshExport& from) {
  const IrradianceMesh& mesh = from.mesh;
  const MeshNodes nodes = NodesToWrite(from.scene, mesh, std::numeric_limits<float>::max());
  const auto [low, high] = from.scene.Bounds();
  const Vec3 centre = 0.5 * (low + high);
  std::string positions, vertices, scales, samples, discontinuities;
  for (const Vec3& position : mesh.positions) AppendTriple<float>(positions, position - centre);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const IrradianceMesh::Triangle& triangle = mesh.triangles[i];
    for (const std::uint32_t vertex : triangle.vertex) AppendBytes(vertices, vertex);
    AppendSamples(nodes, nodes.triangles[i], &scales, &samples);
    int flags = 0;
    for (std::size_t k = 0; k < 3; ++k) flags |= triangle.discontinuity[k] ? 1 << k : 0;
    discontinuities.push_back(static_cast<char>(flags));
  }
  return {Description(from, nodes, centre), positions + vertices + scales + samples + discontinuities};
}

}  // namespace penumbra
