// solver/scene/polygon_soup.h
//
// Collects the polygons that a reader of surfaces finds, by object and material, and makes a scene of them.

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

  // The index of the object with this name, which may be new.
  std::int32_t ObjectNamed(const std::string& name);
  // The index of a material with this name and these values. If another one has the name, the new one gets a
  // number behind its name.
  std::int32_t MaterialLike(const Material& material);
  // A polygon in the frame of the file; `line` is where it stands. Throws InputError if a coordinate is no
  // number or too large.
  void Add(Polygon3 polygon, std::int32_t material, std::int32_t object, int line);
  // Coordinates are rounded to this unit, per axis of the file. The largest counts.
  void AddStep(const Vec3& step) { step_ = step_.cwiseMax(step); }

  std::vector<std::string>& warnings() { return scene_.warnings; }
  const std::string& path() const { return path_; }

  // The scene of all polygons. The warnings begin with a note on what was read as `format`.
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
