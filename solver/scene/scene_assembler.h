// solver/scene/scene_assembler.h
//
// The common last step of all scene readers: checks and repairs the faces that were read, reverses or
// duplicates them if the options say so, and makes patches from them.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

// The largest permitted absolute value of a coordinate [m], so that products of three coordinates, and the
// squares of such products, stay finite.
inline constexpr double kLargestCoordinate = 1e36;

// Counts how often an event occurred, such as the repair of a face, and stores the line of the first
// occurrence.
struct Tally {
  int count = 0, first_line = 0;

  void Add(int line) {
    if (count++ == 0) first_line = line;
  }
};

// Returns the number, followed by the noun in singular or plural: "1 face", "2 faces".
std::string Plural(int count, std::string_view noun, std::string_view one = "", std::string_view many = "s");

class SceneAssembler {
 public:
  // All arguments must outlive the assembler. `file` is the name of the file in messages.
  SceneAssembler(std::string_view file, const SceneOptions& options, Scene& scene)
      : file_(file), options_(options), scene_(scene) {}

  // Checks the bounding box of all faces that will be added; `low` and `high` are its corners [m]. Throws
  // InputError if all sides of the box are shorter than 1e-36 m, so that areas cannot be computed.
  void CheckSize(const Vec3& low, const Vec3& high) const;

  // Sets the largest rounding error of the difference of two vertices of a face [m], for faces that will be
  // added. Unless SetRounding() is called, differences of vertices count as free of rounding errors.
  void SetRounding(double rounding) { rounding_ = rounding; }

  // Appends the face to scene.faces. Repeated vertices of the face are removed, with their texture
  // coordinates; a face without area keeps its index but loses its vertices. `line` is the line of the face
  // in the file; 0 if the file has no lines. Throws InputError if the face crosses itself or is far from
  // planar. If SceneOptions::strict is set, Add() also throws InputError if the face needs a repair. The
  // caller must add the face to Object::faces.
  void Add(Face face, int line);

  // Completes the scene after the last call of Add(). Finish() reverses the faces (SceneOptions::flip), adds
  // backs (SceneOptions::two_sided), appends warnings about repairs, and changes the materials
  // (SceneOptions::change_materials). Finally, Finish() sets scene.coordinate_step and builds the patches.
  void Finish(const Vec3& coordinate_step);

  // Appends a warning of the form "FILE:LINE: warning: COUNT WHAT OUTCOME"; appends nothing if the count is
  // zero.
  void Warn(const Tally& tally, std::string_view what, std::string_view outcome);

  // Throws InputError with the message `message` if SceneOptions::strict is set.
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
  std::vector<int> lines_;  // lines_[f] is the line of the file that gave face f
  double rounding_ = 0;     // the value of FaceTolerances::rounding for faces that will be added [m]
  Tally repeated_, flat_, uneven_;
  // The largest distance d of a vertex of an uneven face from the face's plane [m], and the largest ratio d /
  // (diameter of the face).
  double largest_off_plane_ = 0, largest_off_share_ = 0;
};

}  // namespace penumbra
