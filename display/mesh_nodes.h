// display/mesh_nodes.h
//
// The six nodes of every triangle of an irradiance mesh, with their light, for programs that cannot evaluate
// interpolants. Triangles share a node if their irradiances at the node are equal; where the irradiance
// jumps, there are several nodes at the same position.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/scene/scene.h"

namespace penumbra {

struct MeshNodes {
  struct Node {
    Vec3 position = Vec3::Zero();  // [m]
    Rgb irradiance = Rgb::Zero();  // of the interpolant [W/m^2]; may be negative
    Rgb radiosity = Rgb::Zero();   // irradiance * reflectance + emittance [W/m^2]
    PatchId patch = kNoPatch;
  };
  std::vector<Node> nodes;
  // For each triangle of the mesh, the nodes at its corners 0, 1 and 2, then the nodes at the midpoints of
  // the edges 01, 12 and 20.
  std::vector<std::array<std::uint32_t, 6>> triangles;
  std::vector<std::int32_t> face;  // per triangle: the number of its face in outputs
};

// Two irradiances count as equal if they differ by less than kEqualIrradiance * (largest irradiance of the
// mesh). kEqualIrradiance exceeds the rounding errors of the interpolants' coefficients, and is below the
// precision of a float.
inline constexpr double kEqualIrradiance = 1e-9;

MeshNodes FindMeshNodes(const Scene& scene, const IrradianceMesh& mesh);

// Divides a triangle with six nodes into four counter-clockwise triangles, on which linear functions
// approximate the interpolant.
std::array<std::array<std::uint32_t, 3>, 4> Quarters(const std::array<std::uint32_t, 6>& nodes);

// An exposure for the nodes [m^2/W], determined as by MeterExposure(), but weighted by area instead of by the
// number of pixels.
double MeterNodes(const Scene& scene, const IrradianceMesh& mesh, const MeshNodes& nodes);
// The result of MeterNodes() for all nodes of the mesh.
double MeterMesh(const Scene& scene, const IrradianceMesh& mesh);

}  // namespace penumbra
