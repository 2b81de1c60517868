// display/mesh_nodes.h
//
// The six nodes (corners and edge midpoints) of each triangle of an irradiance mesh, with irradiance and
// radiosity, for programs that cannot evaluate quadratic interpolants. Triangles share a node if their
// irradiances at the node are equal. Where the irradiance jumps, several nodes have the same position.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/scene/scene.h"

namespace penumbra {

struct MeshNodes {
  struct Node {
    Vec3 position = Vec3::Zero();  // position of the node [m]
    Rgb irradiance = Rgb::Zero();  // value of the quadratic interpolant [W/m^2]; may be negative
    Rgb radiosity = Rgb::Zero();   // irradiance * reflectance + emittance [W/m^2]
    PatchId patch = kNoPatch;
  };
  std::vector<Node> nodes;
  // For each triangle of the mesh, the nodes at its corners 0, 1 and 2, then the nodes at the midpoints of
  // the edges 01, 12 and 20.
  std::vector<std::array<std::uint32_t, 6>> triangles;
  std::vector<std::int32_t> face;  // number of the face that contains each triangle, as in outputs
};

// Two irradiances count as equal if they differ by less than kEqualIrradiance * (largest irradiance of the
// mesh). kEqualIrradiance exceeds the rounding errors of the interpolants' coefficients, and is below the
// precision of a float.
inline constexpr double kEqualIrradiance = 1e-9;

MeshNodes FindMeshNodes(const Scene& scene, const IrradianceMesh& mesh);

// Divides a triangle with six nodes into four counter-clockwise triangles, on which linear functions
// approximate the quadratic interpolant.
std::array<std::array<std::uint32_t, 3>, 4> Quarters(const std::array<std::uint32_t, 6>& nodes);

// An exposure that suits the radiosities of the nodes [m^2/W], as MeterExposure() determines it, but with
// areas as weights instead of numbers of pixels.
double MeterNodes(const Scene& scene, const IrradianceMesh& mesh, const MeshNodes& nodes);
// An exposure that suits the radiosities of the mesh [m^2/W]: the result of MeterNodes() for the nodes of all
// triangles.
double MeterMesh(const Scene& scene, const IrradianceMesh& mesh);

}  // namespace penumbra
