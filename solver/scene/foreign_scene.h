// solver/scene/foreign_scene.h
//
// An unchecked scene as read from a file of another program: flat lists of faces, without nodes, instances
// and transformations.

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
  // The range of the face's corners in ForeignScene::corners; the corners are counter-clockwise.
  std::int32_t first = 0, size = 0;
  // The index of the face's material in ForeignScene::materials; -1 if the face has none.
  std::int32_t material = -1;
  std::int32_t object = 0;  // the index of the face's object in ForeignScene::objects
};

struct ForeignScene {
  std::vector<std::string> objects;  // the names of the scene's objects, all different
  std::vector<ForeignMaterial> materials;
  std::vector<Vec3> corners;  // the corners of all faces, in the unit and the axes of the file
  // Texture coordinates of the corners, v upwards, as many as corners; NaN where the file gives none.
  std::vector<Vec2> places;
  std::vector<ForeignFace> faces;
  Vec3 rounding = Vec3::Zero();     // the unit to which coordinates are rounded, for each axis of the file
  std::vector<std::string> lights;  // the names of the file's point lights and other lights without an area
  // The numbers of lines and points, cameras, animations and coloured meshes that are left out.
  std::int32_t lines_and_points = 0, cameras = 0, animations = 0, coloured_meshes = 0;
  std::vector<std::string> files;  // the paths of the further files that were read, such as material files
  double centimetres = 0;          // the length unit of the file in centimetres; 0 if the file gives none
  // The axis that points up: 0 for x, 1 for y, 2 for z; -1 if the file gives none.
  std::int32_t up = -1;
};

// Encodes the scene as bytes, which can be passed from one process to another.
std::string EncodeForeignScene(const ForeignScene& scene);
// Decodes a scene from the bytes that EncodeForeignScene() has returned. Throws std::runtime_error if the
// bytes are no scene, or if indices in the scene are out of range.
ForeignScene DecodeForeignScene(std::string_view bytes);

}  // namespace penumbra
