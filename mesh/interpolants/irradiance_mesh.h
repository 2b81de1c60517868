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
    // The indices of the triangle's vertices in `positions`, counter-clockwise seen from the front.
    std::array<std::uint32_t, 3> vertex;
    PatchId patch = kNoPatch;
    // True for edge k, from vertex k to vertex k + 1, if the edge lies on a discontinuity of the mesh.
    std::array<bool, 3> discontinuity = {false, false, false};
  };

  std::vector<Vec3> positions;  // positions of vertices [m]; only triangles of the same patch share vertices
  std::vector<Triangle> triangles;               // the triangles of all patches, in the order of the patches
  std::vector<QuadraticInterpolant> irradiance;  // the interpolant of the irradiance on each triangle [W/m^2]
};

}  // namespace penumbra
