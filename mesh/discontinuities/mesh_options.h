// mesh/discontinuities/mesh_options.h
//
// Options and reports of the local pass, which computes the mesh from the solution.

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace penumbra {

// The kinds of weights of discontinuities. With both kinds, the weight of a contact is infinite.
enum class DiscontinuityWeight : std::uint8_t {
  kThesis,      // max(d_sb / d_sr) times the source's radiosity (thesis 5.3)
  kIrradiance,  // the error of a leaf's quadratic without the edge (after the thesis's 8.2)
};

// The value of DiscontinuityOptions::choice with which no discontinuity becomes an edge.
inline constexpr const char* kNoDiscontinuities = "none";

// The upper bound of DiscontinuityOptions::corner_divisions.
inline constexpr int kMostCornerDivisions = 20;

// Options that determine which discontinuities become edges of the mesh (thesis 5.2, Appendix A).
struct DiscontinuityOptions {
  std::string choice = "ranked";  // a name in DiscontinuityChoices()
  DiscontinuityWeight weight = DiscontinuityWeight::kThesis;
  double min_weight = 0;  // Tree::minDiscontWeight [W/m^2]
  // With the choice "ranked" and the weight kIrradiance, refinement may request discontinuities of weight <
  // min_weight if the cost of omission is at least min_wanted_weight on some leaf [W/m^2]. If
  // min_wanted_weight >= min_weight, refinement may not request any discontinuity.
  double min_wanted_weight = std::numeric_limits<double>::infinity();
  int max_leaf_dsets = 10;   // Tree::maxLeafDSets: largest number of discontinuity edges in a leaf
  bool keep_hidden = false;  // keep the parts of wedges that other blockers hide, as in the thesis
  // If positive, triple-edge (EEE) events are included, traced as polylines within this distance of the true
  // curve [m]. With 0, triple-edge events are omitted, as in the thesis.
  double triple_edge_tolerance = 0;
  std::uint64_t seed = 1;   // of the random choice
  double random_share = 1;  // share of the discontinuities, apart from contacts, that the random choice tries
  // If a leaf has no room for a discontinuity that other leaves could use as an edge, the leaf is split, and
  // the choice is repeated, at most crowded_splits times. With 0, no leaf is split, as in the thesis. No leaf
  // becomes smaller than min_split_area [m^2].
  int crowded_splits = 0;
  double min_split_area = 0;
  // The leaf that contains the end of a contact is divided corner_divisions times in succession, because no
  // polynomial fits the irradiance near the end. No leaf becomes smaller than min_split_area.
  int corner_divisions = 0;

  // True if the method `choice` makes any discontinuity an edge of the mesh. The functions enabled(),
  // ranks_by_error(), can_want() and LeastWeight() throw InputError if there is no method with the name
  // `choice`.
  bool enabled() const;
  // True if only the cost of omission determines the order of discontinuities.
  bool ranks_by_error() const;
  bool can_want() const { return ranks_by_error() && min_wanted_weight < min_weight; }
  // The smallest weight of a discontinuity that may become an edge, possibly because refinement requests it.
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
  double smooth = 0;  // Interpolation::smooth
};

struct MeshReport {
  struct Counts {
    std::size_t discontinuities = 0;   // found, with at least the minimum weight, or wanted
    std::size_t activated = 0;         // edges of the mesh
    std::size_t dsets_active = 0;      // active DSets, summed over the leaves
    std::size_t refused = 0;           // discontinuities omitted because a leaf was full
    std::size_t refused_contacts = 0;  // of these, contacts: the picture leaks light there
    std::size_t dropped_segments = 0;  // too close to a leaf's border for a conforming triangulation
    std::size_t most_merged = 0;       // largest number of active discontinuities in one edge of a leaf
    std::size_t leaves_split = 0;      // because they were crowded
    std::size_t pairs_traced = 0;      // pairs of receiver and source whose discontinuities were traced
    std::size_t pairs_kept = 0;        // pairs whose traces were known: only the weights changed
    std::size_t leaves_made = 0;       // leaves with lines that were triangulated
    std::size_t leaves_kept = 0;       // leaves whose triangles were reused: same border and lines
    std::size_t triangles = 0;
    std::size_t interpolants = 0;
    std::size_t point_evaluations = 0;  // calls of IrradianceAtPoint()
    std::size_t sources_renewed = 0;  // sources of samples that were gathered again, since the light changed
  };
  struct Seconds {
    double discontinuities = 0, triangulate = 0, interpolate = 0;
  };
  Counts counts;
  Seconds seconds;
};

}  // namespace penumbra
