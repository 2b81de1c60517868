// mesh/discontinuities/mesh_options.h
//
// Options and reports of the local pass, which computes the mesh from the radiosity solution.

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace penumbra {

// The kinds of weights of discontinuities. With both kinds of weights, the weight of a contact with another
// surface is infinite.
enum class DiscontinuityWeight : std::uint8_t {
  // The weight is the largest ratio d_sb / d_sr of the distances source-blocker and source-receiver,
  // multiplied by the source's radiosity (thesis 5.3).
  kThesis,
  // The weight is an estimate of the error of a leaf's quadratic interpolant if no edge of the mesh follows
  // the discontinuity (after thesis 8.2).
  kIrradiance,
};

// The value of DiscontinuityOptions::choice with which no discontinuity becomes an edge.
inline constexpr const char* kNoDiscontinuities = "none";

// The upper bound of DiscontinuityOptions::corner_divisions.
inline constexpr int kMostCornerDivisions = 20;

// Options that determine which discontinuities become edges of the mesh (thesis 5.2, Appendix A).
struct DiscontinuityOptions {
  std::string choice = "ranked";  // method that chooses discontinuities: a name in DiscontinuityChoices()
  DiscontinuityWeight weight = DiscontinuityWeight::kThesis;
  // The smallest weight of a discontinuity that becomes an edge, Tree::minDiscontWeight in the thesis
  // [W/m^2].
  double min_weight = 0;
  // With the choice "ranked" and the weight kIrradiance, mesh refinement may request edges along
  // discontinuities of weight < min_weight. Refinement may request an edge along a discontinuity only if, on
  // some quadtree leaf, the error of the mesh without an edge along the discontinuity (OmissionCost) is at
  // least min_wanted_weight [W/m^2]. If min_wanted_weight >= min_weight, mesh refinement may not request any
  // edges along discontinuities.
  double min_wanted_weight = std::numeric_limits<double>::infinity();
  // The largest number of discontinuity edges in a quadtree leaf, Tree::maxLeafDSets in the thesis.
  int max_leaf_dsets = 10;
  // If true, the parts of discontinuities that other blockers hide are kept, as in the thesis.
  bool keep_hidden = false;
  // If triple_edge_tolerance is positive, triple-edge (EEE) discontinuities are included, traced as polylines
  // within this distance of the true curve [m]. If triple_edge_tolerance is 0, triple-edge discontinuities
  // are omitted, as in the thesis.
  double triple_edge_tolerance = 0;
  std::uint64_t seed = 1;  // seed of the random order in which the choice "random" takes discontinuities
  // Fraction of the discontinuities, apart from contacts, that the choice "random" tries to make edges of the
  // mesh.
  double random_share = 1;
  // If a quadtree leaf with the largest allowed number of lines keeps a discontinuity from becoming a mesh
  // edge (PatchDSets::crowded), the leaf is split, and the choice of discontinuities is repeated, at most
  // crowded_splits times. If crowded_splits is 0, no leaf is split, as in the thesis. Splitting for further
  // lines makes no leaf smaller than min_split_area [m^2].
  int crowded_splits = 0;
  double min_split_area = 0;
  // The quadtree leaf that contains the end of a contact with another surface is divided corner_divisions
  // times in succession, because no polynomial fits the irradiance near the end. Divisions at the end of a
  // contact make no quadtree leaf smaller than min_split_area [m^2].
  int corner_divisions = 0;

  // True if the method `choice` can make discontinuities edges of the mesh, false if the method always omits
  // all discontinuities. The functions enabled(), ranks_by_error(), can_want() and LeastWeight() throw
  // InputError if there is no method with the name `choice`.
  bool enabled() const;
  // True if discontinuities become edges in the order of their cost of omission: the error of the mesh
  // without an edge along the discontinuity (OmissionCost).
  bool ranks_by_error() const;
  bool can_want() const { return ranks_by_error() && min_wanted_weight < min_weight; }
  // The smallest weight of a discontinuity that may become an edge: min_wanted_weight if refinement may
  // request edges along discontinuities below min_weight, otherwise min_weight.
  double LeastWeight() const { return can_want() ? min_wanted_weight : min_weight; }
};

enum class InterpolantOrder : std::uint8_t {
  kConstant,   // constant irradiance of each quadtree leaf, from the radiosity solution
  kLinear,     // linear interpolants of samples at the vertices (Gouraud)
  kQuadratic,  // quadratic interpolants of samples at vertices and edge midpoints
};

struct MeshOptions {
  DiscontinuityOptions discontinuities;
  InterpolantOrder order = InterpolantOrder::kQuadratic;
  // The limit, relative to the irradiance, below which the irradiance at an edge's midpoint is predicted from
  // the vertices of the mesh instead of sampled (Interpolation::smooth).
  double smooth = 0;
};

struct MeshReport {
  struct Counts {
    // Number of discontinuities that have at least the minimum weight, or along which refinement requested an
    // edge.
    std::size_t discontinuities = 0;
    std::size_t activated = 0;  // number of discontinuities that are edges of the mesh
    // The number of pairs of quadtree leaf and discontinuity line that give mesh edges (active DSets).
    std::size_t dsets_active = 0;
    // The number of discontinuities that are no mesh edges because a leaf already had the largest number of
    // lines.
    std::size_t refused = 0;
    // The number of contacts between surfaces that are no mesh edges because a leaf already had the largest
    // number of lines; pictures show light leaking through such contacts.
    std::size_t refused_contacts = 0;
    // The number of discontinuity edges omitted because their distance from the border of a quadtree leaf is
    // within rounding.
    std::size_t dropped_segments = 0;
    std::size_t most_merged = 0;  // largest number of collinear discontinuities along one edge in a leaf
    // The number of leaves split because they already had the largest allowed number of discontinuity lines.
    std::size_t leaves_split = 0;
    std::size_t pairs_traced = 0;  // number of pairs receiver-source whose discontinuities were computed
    std::size_t pairs_kept = 0;    // number of pairs receiver-source whose discontinuities were in the cache
    // Number of quadtree leaves with discontinuity lines that were triangulated anew.
    std::size_t leaves_made = 0;
    // Number of quadtree leaves with discontinuity lines whose triangles were reused.
    std::size_t leaves_kept = 0;
    std::size_t triangles = 0;
    std::size_t interpolants = 0;
    std::size_t point_evaluations = 0;  // number of calls of IrradianceAtPoint()
    // Number of pairs (source, sample point) for which the light of the source at the point was gathered
    // again after a change of the light.
    std::size_t sources_renewed = 0;
  };
  struct Seconds {
    double discontinuities = 0, triangulate = 0, interpolate = 0;
  };
  Counts counts;
  Seconds seconds;
};

}  // namespace penumbra
