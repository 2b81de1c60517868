// solver/scene/scene_assembler.h
//
// What all readers of scene files do with the faces that they read: faces are checked and repaired, turned
// and repeated as the options ask, and made into patches.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

// The largest absolute value of a coordinate [m]: products of three coordinates and their squares stay
// finite.
inline constexpr double kLargestCoordinate = 1e36;

// How often something happened, and where first.
struct Tally {
  int count = 0, first_line = 0;

  void Add(int line) {
    if (count++ == 0) first_line = line;
  }
};

// "1 face", "2 faces".
std::string Plural(int count, std::string_view noun, std::string_view one = "", std::string_view many = "s");

class SceneAssembler {
 public:
  // All three must outlive the assembler. `file` is the name in messages.
  SceneAssembler(std::string_view file, const SceneOptions& options, Scene& scene)
      : file_(file), options_(options), scene_(scene) {}

  // The limits of all corners of faces that will be added [m]. Throws InputError if they are so close to one
  // another that areas cannot be computed: within 1e-36 m.
  void CheckSize(const Vec3& low, const Vec3& high) const;

  // The rounding of the differences of two vertices of faces that will be added [m]. The default is 0.
  void SetRounding(double rounding) { rounding_ = rounding; }

  // Appends the face to scene.faces. Repeated vertices are removed; a face without area keeps its place but
  // loses its vertices. `line` is where the face stands in the file; 0 if the file has no lines. Throws
  // InputError if the face crosses itself or is far from planar, and, with SceneOptions::strict, if it needs
  // a repair. The caller enters the face in Object::faces.
  void Add(Face face, int line);

  // Ends the scene after the last face: turns and repeats faces (SceneOptions::flip and two_sided), appends
  // the warnings about repairs, changes the materials, sets scene.coordinate_step, builds the patches.
  void Finish(const Vec3& coordinate_step);

  // Appends a warning, "FILE:LINE: warning: COUNT WHAT OUTCOME"; none if the tally is zero.
  void Warn(const Tally& tally, std::string_view what, std::string_view outcome);

  // Throws InputError if SceneOptions::strict is set.
  void Refuse(int line, std::string_view message) const;

 private:
  void Check(Polygon3& polygon, int line);
  std::string FaceName(int line) const;
  void AddBacks();
  void WarnOfRepairs();
  void BuildScenePatches();

  std::string file_;
  const SceneOptions& options_;
  Scene& scene_;
  std::vector<int> lines_;  // of the faces that were added
  double rounding_ = 0;     // FaceTolerances::rounding
  Tally repeated_, flat_, uneven_;
  double largest_off_plane_ = 0, largest_off_share_ = 0;  // of uneven faces [m]; of their diameters
};

}  // namespace penumbra
