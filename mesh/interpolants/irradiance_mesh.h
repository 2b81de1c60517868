// mesh/interpolants/irradiance_mesh.h
//
// The result of the solver and the input of the display (thesis, abstract): a list of triangles with one
// irradiance interpolant each. The display needs only this mesh and the materials.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/interpolants/quadratic_interpolant.h"
#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"

namespace penumbra {

struct IrradianceMesh {
  struct Triangle {
    std::array<std::uint32_t, 3> vertex;  // indices in `positions`, counter-clockwise seen from the front
    PatchId patch = kNoPatch;
    // True for edge k, from vertex k to vertex k + 1, if the edge lies on a discontinuity of the mesh.
    std::array<bool, 3> discontinuity = {false, false, false};
  };

  std::vector<Vec3> positions;  // positions of vertices [m]; only triangles of the same patch share vertices
  std::vector<Triangle> triangles;               // triangles of all patches, in the order of patches
  std::vector<QuadraticInterpolant> irradiance;  // interpolant of each triangle [W/m^2]
};

}  // namespace penumbra
