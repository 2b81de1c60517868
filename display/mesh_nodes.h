// display/mesh_nodes.h
//
// The six nodes of every triangle of an irradiance mesh, with their light, for programs without interpolants.
// Triangles share a node if they have the same light there; where the light jumps, one position has several
// nodes.

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
  // Per triangle of the mesh: the nodes of its corners 0, 1, 2, then of the midpoints of the edges 01, 12 and
  // 20.
  std::vector<std::array<std::uint32_t, 6>> triangles;
  std::vector<std::int32_t> face;  // per triangle: the number of its face in outputs
};

// Irradiances are equal if they differ by less than kEqualIrradiance times the mesh's largest irradiance: the
// rounding of the coefficients, and less than the precision of a float.
inline constexpr double kEqualIrradiance = 1e-9;

MeshNodes FindMeshNodes(const Scene& scene, const IrradianceMesh& mesh);

// The four triangles between the six nodes of a triangle, counter-clockwise: the piecewise linear
// approximation of the interpolant.
std::array<std::array<std::uint32_t, 3>, 4> Quarters(const std::array<std::uint32_t, 6>& nodes);

// An exposure for the nodes [m^2/W], metered as MeterExposure() does, with areas in place of pixel counts.
double MeterNodes(const Scene& scene, const IrradianceMesh& mesh, const MeshNodes& nodes);
// The same of all nodes of the mesh.
double MeterMesh(const Scene& scene, const IrradianceMesh& mesh);

}  // namespace penumbra
