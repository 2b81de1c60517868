// mesh/interpolants/irradiance_mesh.h
//
// Where the offline half and the online half meet (thesis, abstract): a list of triangles, each with an
// irradiance interpolant. The display needs nothing else but the materials.

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
    std::array<std::uint32_t, 3> vertex;  // indices in `positions`, counter-clockwise from the front
    PatchId patch = kNoPatch;
    // Edge k runs from vertex k to vertex k + 1: true if it lies on a discontinuity of the mesh.
    std::array<bool, 3> discontinuity = {false, false, false};
  };

  std::vector<Vec3> positions;      // [m]; triangles of one patch share vertices, patches do not
  std::vector<Triangle> triangles;  // the triangles of a patch are consecutive, patches ascending
  std::vector<QuadraticInterpolant> irradiance;  // one a triangle [W/m^2]
};

}  // namespace penumbra
