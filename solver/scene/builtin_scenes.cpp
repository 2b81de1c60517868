#include "solver/scene/builtin_scenes.h"

#include <utility>

#include "solver/base/check.h"
#include "solver/scene/building.h"
#include "solver/scene/embedded_scenes.h"
#include "solver/scene/obj_reader.h"

namespace penumbra {
namespace {

Camera At(std::string name, const Vec3& eye, const Vec3& look_at, double vertical_fov) {
  return {std::move(name), eye, look_at, Vec3::UnitZ(), vertical_fov};
}

std::optional<std::string> EmbeddedText(std::string_view file) {
  for (const EmbeddedFile& embedded : EmbeddedSceneFiles())
    if (embedded.name == file) return std::string(embedded.text);
  return std::nullopt;
}

// Null if there is none of that name.
const BuiltinScene* FindBuiltinScene(std::string_view name) {
  for (const BuiltinScene& scene : BuiltinScenes())
    if (scene.name == name) return &scene;
  return nullptr;
}

// The cameras of a scene that is read in another frame than its own.
std::vector<Camera> InFrame(std::vector<Camera> cameras, const SceneOptions& options) {
  const SceneFrame frame = {options.unit.value_or(LengthUnit{"m"}), options.up.value_or(UpAxis::kZ)};
  for (Camera& camera : cameras) {
    camera.eye = frame.Position(camera.eye);
    camera.look_at = frame.Position(camera.look_at);
    camera.up = frame.Direction(camera.up);
  }
  return cameras;
}

class BuiltinSceneReader final : public SceneReader {
 public:
  bool Recognises(const SceneSource& source) const override {
    return !source.is_file && (BuildingNamed(source.name) || FindBuiltinScene(source.name));
  }
  Scene Read(const std::string& name, const SceneOptions& options) const override {
    std::optional<Scene> scene = LoadBuiltinScene(name, options);
    PENUMBRA_CHECK(scene.has_value());
    return std::move(*scene);
  }
};

}  // namespace

const std::vector<BuiltinScene>& BuiltinScenes() {
  static const std::vector<BuiltinScene> scenes = {
      {"office",
       "a furnished room after the thesis's figures 7-1 and 7-2: desk, chair, shelves, picture, two lights",
       {At("room", {3.55, 0.35, 1.7}, {1.55, 2.6, 0.85}, 55),
        At("above", {3.3, -2.2, 5.2}, {1.9, 1.95, 0.6}, 40),
        At("corner", {2.7, 0.9, 1.45}, {0.75, 3.2, 1.45}, 50),
        At("desk", {3.2, 1.3, 0.55}, {1.7, 2.6, 0.35}, 50)}},
      {"cornell",
       "the Cornell box with its published measured geometry and reflectances",
       {At("published", {0.278, 0.8, 0.273}, {0.278, 0, 0.273}, 39.3077),
        At("blocks", {0.1, 0.1, 0.42}, {0.3, -0.3, 0.1}, 50),
        At("ceiling", {0.28, 0.15, 0.08}, {0.28, -0.35, 0.4}, 55)}},
      {"floating-cube",
       "a cube floating above a plane under two area lights; an open scene",
       {At("front", {2.6, -3.4, 2.4}, {0, 0, 0.5}, 42), At("above", {0.3, -0.6, 5.2}, {0, 0, 0}, 50),
        At("low", {-2.6, -2.6, 0.7}, {0, 0, 0.5}, 45)}},
      {"blind",
       "a window behind a blind of 32 slats in an empty room: many shadow lines close to each other",
       {At("room", {3.7, 0.4, 1.9}, {0.6, 2.3, 1.0}, 60), At("above", {2.2, 2, 2.5}, {2, 2.1, 0}, 75),
        At("floor", {2.6, 1.1, 0.9}, {0.7, 2.2, 0.1}, 60)}},
      {"furnace",
       "a closed box of reflectance 1/2 and emittance 1/2 whose exact irradiance and radiosity are 1 "
       "everywhere",
       {At("inside", {0.9, 0.1, 0.8}, {0.3, 0.7, 0.3}, 60)}},
      {"building-1x1",
       "a furnished room made from its number; building-RxC joins R by C of them by doorways (up to " +
           std::to_string(kMostRooms) + " each way)",
       BuildingCameras({1, 1})},
  };
  return scenes;
}

std::optional<Scene> LoadBuiltinScene(std::string_view name, const SceneOptions& options) {
  if (const std::optional<BuildingSize> size = BuildingNamed(name)) {
    Scene scene = ReadObjText(
        BuildingObj(*size), std::string(name) + ".obj", [](std::string_view) { return BuildingMtl(); },
        options);
    scene.name = name;
    scene.warnings.clear();  // as below
    scene.cameras = InFrame(BuildingCameras(*size), options);
    return scene;
  }
  const BuiltinScene* found = FindBuiltinScene(name);
  if (!found) return std::nullopt;
  const std::string file = found->name + ".obj";
  const std::optional<std::string> text = EmbeddedText(file);
  PENUMBRA_CHECK(text.has_value());
  Scene scene = ReadObjText(
      *text, file, [](std::string_view mtl) { return EmbeddedText(mtl); }, options);
  scene.name = found->name;
  // What their files leave to be repaired is meant: a light in an uncut ceiling, a block on an uncut floor.
  scene.warnings.clear();
  scene.cameras = InFrame(found->cameras, options);
  return scene;
}

SceneReaderRegistry::Method BuiltinSceneReaderMethod() {
  return {"built-in", "the scenes that the program brings along, by name", {}, [] {
            return std::make_unique<const BuiltinSceneReader>();
          }};
}

}  // namespace penumbra
