// python/array_scene.h
//
// Makes scenes from arrays of vertices and faces.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

struct SceneArrays {
  std::string name = "scene";
  std::vector<Vec3> vertices;                    // positions of the vertices [m]
  std::vector<std::vector<std::int64_t>> faces;  // vertex indices of each face, from 0, counter-clockwise
  std::vector<Rgb> reflectance, emittance;       // reflectance, in [0, 1), and emittance [W/m^2] of each face
  std::vector<std::string> objects;  // object name of each face; empty if all faces form one object
};

// Returns the scene of the arrays, including its patches. The arrays are processed like an OBJ file that
// holds the same numbers with all digits: faces are checked, repaired and rounded in the same way, and the
// solution is the same to the bit. Throws InputError, whose message names the wrong face or vertex, counted
// from 0.
Scene SceneFromArrays(const SceneArrays& arrays, const SceneOptions& options);

}  // namespace penumbra
