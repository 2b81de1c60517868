// mesh/discontinuities/mesh_options.h
//
// What the local pass can be told, and what it reports.

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace penumbra {

// What a discontinuity weighs. A contact weighs infinitely much in either way.
enum class DiscontinuityWeight : std::uint8_t {
  kThesis,      // how near the blocker is to the receiver, times the source's radiosity (thesis 5.3)
  kIrradiance,  // the error that a leaf's quadratic would make without the edge (after the thesis's 8.2)
};

// The DiscontinuityOptions::choice that makes no discontinuity an edge.
inline constexpr const char* kNoDiscontinuities = "none";

// Of DiscontinuityOptions::corner_divisions.
inline constexpr int kMostCornerDivisions = 20;

// Which discontinuities become edges of the mesh (thesis 5.2, Appendix A).
struct DiscontinuityOptions {
  std::string choice = "ranked";  // of DiscontinuityChoices()
  DiscontinuityWeight weight = DiscontinuityWeight::kThesis;
  double min_weight = 0;  // Tree::minDiscontWeight [W/m^2]
  // Ranked by the irradiance weight, refinement may ask for lighter ones that cost at least this on some leaf
  // [W/m^2]; for none if it is not below min_weight.
  double min_wanted_weight = std::numeric_limits<double>::infinity();
  int max_leaf_dsets = 10;   // Tree::maxLeafDSets: discontinuity edges within one leaf
  bool keep_hidden = false;  // also the parts of wedges that end at another blocker, as in the thesis
  // Triple-edge (EEE) events as well, traced as polylines within this distance [m]; 0: none, as in the
  // thesis.
  double triple_edge_tolerance = 0;
  std::uint64_t seed = 1;   // of the random order
  double random_share = 1;  // of the discontinuities but contacts, those that a random choice looks at
  // Leaves that are too full for a discontinuity, which other leaves would take, are split as often as this;
  // 0: not, as in the thesis. None becomes smaller than the area [m^2].
  int crowded_splits = 0;
  double min_split_area = 0;
  // Leaves where a contact edge ends are divided so many times towards the end, for no polynomial fits there;
  // none beyond the same area.
  int corner_divisions = 0;

  // Whether the choice takes any. This and what follows throw InputError if no choice has its name.
  bool enabled() const;
  // Whether what leaving it out would cost decides alone about a discontinuity.
  bool ranks_by_error() const;
  bool can_want() const { return ranks_by_error() && min_wanted_weight < min_weight; }
  // Of what may become an edge, if refinement asks for it.
  double LeastWeight() const { return can_want() ? min_wanted_weight : min_weight; }
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
    std::size_t discontinuities = 0;   // found, with at least the minimum weight on their own, or wanted
    std::size_t activated = 0;         // edges of the mesh
    std::size_t dsets_active = 0;      // active DSets, summed over the leaves
    std::size_t refused = 0;           // left out because a leaf was full
    std::size_t refused_contacts = 0;  // of these, contacts: there the picture leaks
    std::size_t dropped_segments = 0;  // too close to a leaf's border for a conforming triangulation
    std::size_t most_merged = 0;       // active discontinuities in one discontinuity edge of a leaf
    std::size_t leaves_split = 0;      // since they were crowded
    std::size_t pairs_traced = 0;      // of receiver and source: their edges were found anew
    std::size_t pairs_kept = 0;        // and those that had been found before: only weights changed
    std::size_t leaves_made = 0;       // leaves with lines that were triangulated
    std::size_t leaves_kept = 0;       // and those whose border and lines had not changed
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
