// Example 5: a scene of your own, made by code.
//
//   example_5_own_scene [PICTURE.png]

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "display/png_image.h"
#include "display/tone_mapping.h"
#include "display/two_pass_display.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/check.h"
#include "solver/scene/patch_builder.h"

using namespace penumbra;

namespace {

// 1. A material reflects a fraction of the light, in red, green and blue, and may emit light [W/m^2].
std::int32_t AddMaterial(Scene& scene, const std::string& name, const Rgb& reflectance,
                         const Rgb& emittance) {
  scene.materials.push_back({name, reflectance, emittance});
  return static_cast<std::int32_t>(scene.materials.size()) - 1;
}

// 2. An object is a named group of faces.
std::int32_t AddObject(Scene& scene, const std::string& name) {
  scene.objects.push_back({name, {}});
  return static_cast<std::int32_t>(scene.objects.size()) - 1;
}

// 3. A face is a polygon [m]. Its front is the side from which its vertices run counter-clockwise. Only the
//    front reflects and emits.
void AddFace(Scene& scene, std::int32_t object, std::int32_t material, const Polygon3& vertices) {
  scene.objects[static_cast<std::size_t>(object)].faces.push_back(
      static_cast<std::int32_t>(scene.faces.size()));
  scene.faces.push_back({vertices, material, object});
}

// The six faces of a box along the axes, with their fronts outside, or inside for a room.
void AddBox(Scene& scene, std::int32_t object, std::int32_t material, const Vec3& low, const Vec3& high,
            bool inside) {
  const auto corner = [&](int i) {
    return Vec3((i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z());
  };
  constexpr std::array<std::array<int, 4>, 6> kSides = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const std::array<int, 4>& side : kSides) {
    Polygon3 face;
    for (const int i : side) face.push_back(corner(i));
    if (inside) std::reverse(face.begin(), face.end());
    AddFace(scene, object, material, face);
  }
}

Scene MakeScene() {
  Scene scene;
  scene.name = "room with two blocks";
  const Rgb dark = Rgb::Zero();
  const std::int32_t wall = AddMaterial(scene, "wall", {0.7, 0.7, 0.65}, dark);
  const std::int32_t red = AddMaterial(scene, "red", {0.6, 0.15, 0.1}, dark);
  const std::int32_t lamp = AddMaterial(scene, "lamp", {0.5, 0.5, 0.5}, {60, 55, 45});

  // 4. Put the objects together. Blocks may stand on the uncut floor, and the lamp may lie in the uncut
  //    ceiling: the library finds out what is covered.
  AddBox(scene, AddObject(scene, "room"), wall, {0, 0, 0}, {4, 3, 2.5}, /*inside=*/true);
  AddBox(scene, AddObject(scene, "low block"), red, {0.8, 1.2, 0}, {1.6, 2.0, 0.6}, /*inside=*/false);
  AddBox(scene, AddObject(scene, "high block"), wall, {2.4, 1.6, 0}, {2.9, 2.1, 1.4}, /*inside=*/false);
  AddFace(scene, AddObject(scene, "lamp"), lamp,
          {{1.5, 1, 2.5}, {1.5, 1.6, 2.5}, {2.3, 1.6, 2.5}, {2.3, 1, 2.5}});

  // 5. Make the patches on which the solver works. They are convex, and none covers another.
  const PatchReport report = BuildPatches(scene);
  fmt::print("{} faces, {} of them cut, give {} patches\n", scene.faces.size(), report.cut_faces.size(),
             scene.patches.size());
  return scene;
}

}  // namespace

int main(int argc, char** argv) try {
  const Scene scene = MakeScene();

  // 6. Solve, as in example 1. In a closed room no light escapes.
  const ExecutionContext context;
  PipelineOptions options;
  options.error = 0.1;
  Pipeline pipeline(scene, options);
  pipeline.Solve(context);
  pipeline.RefineLight(context);
  pipeline.BuildMesh(MeshKind::kInterpolant, context);
  pipeline.Diagnose(context);
  const EnergyBalance& energy = pipeline.report().energy;
  fmt::print("emitted {:.2f} W, absorbed {:.2f} W, escaped {:.2f} W\n", energy.emitted, energy.absorbed,
             energy.escaped);

  // 7. Look at it from a corner of the room.
  const Camera camera = {"corner", {0.2, 0.2, 1.8}, {2.4, 1.9, 0.5}, Vec3::UnitZ(), 65};
  TwoPassDisplay display(scene, pipeline.mesh());
  const RenderedFrame& frame = display.Render(camera, 480, 360);
  ToneMapping tone;
  tone.exposure = MeterExposure(frame.linear, frame.kind);
  WritePng(argc > 1 ? argv[1] : "own_scene.png", display.ToneMap(tone).screen);
  return energy.escaped == 0 ? 0 : 1;
} catch (const InputError& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
