// python/array_scene.h
//
// Scenes from arrays of vertices and faces.

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
  std::vector<Vec3> vertices;                    // [m]
  std::vector<std::vector<std::int64_t>> faces;  // the vertices of each face, from 0, counter-clockwise
  std::vector<Rgb> reflectance, emittance;       // of each face; in [0, 1), and in W/m^2
  std::vector<std::string> objects;              // the object of each face; empty: all are of one
};

// The scene, including its patches. The arrays are read as the OBJ file that holds them with all digits, so
// that they are checked, repaired and rounded as a file is, and solve to the bit as the file does. Throws
// InputError that names the face or vertex, counted from 0.
Scene SceneFromArrays(const SceneArrays& arrays, const SceneOptions& options);

}  // namespace penumbra
