// solver/scene/polygon_soup.h
//
// Collects the polygons that a scene reader finds in a file, with their objects and materials, and makes a
// scene of the polygons.

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/scene/scene_assembler.h"
#include "solver/scene/scene_frame.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

class PolygonSoup {
 public:
  PolygonSoup(const std::string& path, const SceneOptions& options);

  // Returns the index of the object called `name`; adds an object if none has this name.
  std::int32_t ObjectNamed(const std::string& name);
  // Returns the index of a material with the same name, reflectance and emittance as `material`; adds the
  // material if none is equal. If another material has the same name but other values, a number is appended
  // to the name of the added material.
  std::int32_t MaterialLike(const Material& material);
  // Adds a polygon, whose coordinates have the unit and the axes of the file; `line` is the line of the file.
  // Throws InputError if a coordinate is no number or too large.
  void Add(Polygon3 polygon, std::int32_t material, std::int32_t object, int line);
  // Declares the unit to which coordinates are rounded, for each axis of the file; of several calls, the
  // largest unit counts.
  void AddStep(const Vec3& step) { step_ = step_.cwiseMax(step); }

  std::vector<std::string>& warnings() { return scene_.warnings; }
  const std::string& path() const { return path_; }

  // Returns the scene of all added polygons. The scene's warnings begin with a note that says what was read;
  // `format` is the name of the file format.
  Scene Finish(std::string_view format);

 private:
  struct Piece {
    Face face;
    int line = 0;
  };

  std::string path_;
  const SceneOptions& options_;
  SceneFrame frame_;
  Scene scene_;
  std::vector<Piece> pieces_;
  std::map<std::string, std::int32_t, std::less<>> object_index_;
  std::map<std::string, std::vector<std::int32_t>, std::less<>> material_index_;
  Vec3 step_ = Vec3::Zero();
};

}  // namespace penumbra
