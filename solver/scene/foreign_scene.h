// solver/scene/foreign_scene.h
//
// A scene as a reader of another program's files finds it, before it is checked: flat lists without nodes,
// instances and transformations.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

struct ForeignMaterial {
  std::string name;
  Rgb diffuse = Rgb::Constant(0.5), emission = Rgb::Zero();
  bool textured = false, transparent = false, two_sided = false;
};

struct ForeignFace {
  std::int32_t first = 0, size = 0;  // of its corners in ForeignScene::corners, counter-clockwise
  std::int32_t material = -1;        // in ForeignScene::materials; -1: none
  std::int32_t object = 0;           // in ForeignScene::objects
};

struct ForeignScene {
  std::vector<std::string> objects;  // names, all different
  std::vector<ForeignMaterial> materials;
  std::vector<Vec3> corners;  // in the unit and the axes of the file
  std::vector<ForeignFace> faces;
  Vec3 rounding = Vec3::Zero();     // per axis, the unit to which corners are rounded
  std::vector<std::string> lights;  // names of lights without an area
  std::int32_t lines_and_points = 0, cameras = 0, animations = 0, coloured_meshes = 0;  // what is left out
  std::vector<std::string> files;  // that were read beside the file itself
  double centimetres = 0;          // one unit of the file in cm; 0 if the file does not say
  std::int32_t up = -1;            // the axis that points up: 0, 1 or 2; -1 if the file does not say
};

// The scene as bytes, for the way from one process to another.
std::string EncodeForeignScene(const ForeignScene& scene);
// The scene that these bytes hold. Throws std::runtime_error if the bytes are no scene, or indices in the
// scene are out of range.
ForeignScene DecodeForeignScene(std::string_view bytes);

}  // namespace penumbra
