// mesh/mesh_options.h
//
// What the local pass can be told, and what it reports.

#pragma once

#include <cstddef>
#include <cstdint>

namespace penumbra {

// Which discontinuities become edges of the mesh (thesis 5.2, Appendix A).
struct DiscontinuityOptions {
  bool enabled = true;      // false: the leaves alone
  double min_weight = 0;    // Tree::minDiscontWeight [W/m^2]; contacts weigh infinitely much
  int max_leaf_dsets = 10;  // Tree::maxLeafDSets: discontinuity edges within one leaf
};

enum class InterpolantOrder : std::uint8_t {
  kConstant,   // the leaf's irradiance in the solution
  kLinear,     // samples at the vertices (Gouraud)
  kQuadratic,  // samples at vertices and edge midpoints
};

struct MeshOptions {
  DiscontinuityOptions discontinuities;
  InterpolantOrder order = InterpolantOrder::kQuadratic;
};

struct MeshReport {
  struct Counts {
    std::size_t discontinuities = 0;   // found, with at least the minimum weight
    std::size_t activated = 0;         // of these, edges of the mesh
    std::size_t dsets_active = 0;      // active DSets, summed over the leaves
    std::size_t refused = 0;           // left out because a leaf was full
    std::size_t refused_contacts = 0;  // of these, contacts: there the picture leaks
    std::size_t dropped_segments = 0;  // too close to a leaf's border for a conforming triangulation
    std::size_t triangles = 0;
    std::size_t interpolants = 0;
    std::size_t point_evaluations = 0;  // calls of IrradianceAtPoint()
  };
  struct Seconds {
    double discontinuities = 0, triangulate = 0, interpolate = 0;
  };
  Counts counts;
  Seconds seconds;
};

}  // namespace penumbra
