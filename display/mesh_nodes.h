// display/mesh_nodes.h
//
// The six nodes of every triangle of an irradiance mesh with the light there, for programs that know no
// interpolants: what a node's triangles agree about is one node, and where the light jumps, there are
// several.

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
    Rgb irradiance = Rgb::Zero();  // the interpolant's [W/m^2]; it may dip below 0
    Rgb radiosity = Rgb::Zero();   // times reflectance, plus emittance [W/m^2]
    PatchId patch = kNoPatch;
  };
  std::vector<Node> nodes;
  // Per triangle of the mesh: its corners 0, 1, 2, then the middles of the edges 01, 12 and 20.
  std::vector<std::array<std::uint32_t, 6>> triangles;
  std::vector<std::int32_t> face;  // per triangle: the number of the face that it lies on, as users count
};

// Values count as one where they differ by less than this share of the mesh's largest: rounding of the
// coefficients, and less than a float holds.
inline constexpr double kSameLight = 1e-9;

MeshNodes FindMeshNodes(const Scene& scene, const IrradianceMesh& mesh);

// The four triangles of a triangle's six nodes, counter-clockwise: the interpolant, straight between nodes.
std::array<std::array<std::uint32_t, 3>, 4> Quarters(const std::array<std::uint32_t, 6>& nodes);

// The exposure [m^2/W] that shows the nodes like MeterExposure() shows a picture: by area.
double MeterNodes(const Scene& scene, const IrradianceMesh& mesh, const MeshNodes& nodes);
// The same of all nodes of the mesh.
double MeterMesh(const Scene& scene, const IrradianceMesh& mesh);

}  // namespace penumbra
