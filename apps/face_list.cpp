#include "apps/face_list.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "solver/geometry/polygon.h"

namespace penumbra {
namespace {

using Json = nlohmann::ordered_json;

std::string Triple(double x, double y, double z) { return fmt::format("{:g},{:g},{:g}", x, y, z); }
std::string Triple(const Vec3& v) { return Triple(v.x(), v.y(), v.z()); }
std::string Triple(const Rgb& c) { return Triple(c[0], c[1], c[2]); }

Json ToJson(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

// Null if the scene has no objects.
const Object* ObjectOf(const Scene& scene, const Face& face) {
  return scene.objects.empty() ? nullptr : &scene.objects[static_cast<std::size_t>(face.object)];
}

}  // namespace

std::string FaceListText(const Scene& scene) {
  std::string text;
  for (std::size_t i = 0; i < scene.faces.size(); ++i) {
    const Face& face = scene.faces[i];
    const Material& material = scene.materials[static_cast<std::size_t>(face.material)];
    const Vec3 area = VectorArea(face.vertices);
    const Object* object = ObjectOf(scene, face);
    text +=
        fmt::format("face {}: object {}, material {}\n", i, object ? object->name : "none", material.name);
    text += fmt::format("  area {:g} m^2, centroid {} m, normal {}\n", area.norm(),
                        Triple(Centroid(face.vertices)), Triple(Vec3(area.stableNormalized())));
    text += fmt::format("  reflectance {}, emittance {} W/m^2\n", Triple(material.reflectance),
                        Triple(material.emittance));
    for (const Vec3& corner : face.vertices) text += fmt::format("  corner {} m\n", Triple(corner));
  }
  return text;
}

Json FaceListJson(const Scene& scene, bool with_corners) {
  Json faces = Json::array();
  for (std::size_t i = 0; i < scene.faces.size(); ++i) {
    const Face& face = scene.faces[i];
    const Vec3 area = VectorArea(face.vertices);
    const Object* object = ObjectOf(scene, face);
    Json entry = {{"face", i},
                  {"object", object ? Json(object->name) : Json()},
                  {"material", scene.materials[static_cast<std::size_t>(face.material)].name},
                  {"vertices", face.vertices.size()},
                  {"area", area.norm()},
                  {"normal", ToJson(area.stableNormalized())}};
    if (with_corners) {
      entry["centroid"] = ToJson(Centroid(face.vertices));
      entry["corners"] = Json::array();
      for (const Vec3& corner : face.vertices) entry["corners"].push_back(ToJson(corner));
    }
    faces.push_back(std::move(entry));
  }
  return faces;
}

}  // namespace penumbra
