// mesh/discontinuities/dset.h
//
// DSets (thesis 5.5.4-5.5.7) determine which discontinuities of a patch become edges of the leaves'
// triangulations. A DSet is a pair of a discontinuity line and a quadtree leaf. A DSet contains those
// discontinuities on its line that meet its leaf. Each DSet (pair of line and leaf) contributes at most one
// edge to the triangulation of its leaf.
//
// The thesis stores DSets in every node of the quadtree and passes the DSets on to the children when a node
// is split. In this implementation, the discontinuity lines of a patch are found once, when the quadtree is
// final, and leaves refer to the lines by number.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/discontinuity_choice.h"
#include "mesh/discontinuities/discontinuity_line.h"
#include "mesh/discontinuities/mesh_options.h"
#include "mesh/discontinuities/omission_cost.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

// A discontinuity that is no edge of the mesh because its weight is too small. An OmittedDiscontinuity lists
// the parts of the discontinuity on leaves that have no edge along its line.
struct OmittedDiscontinuity {
  std::size_t number = 0;  // index of the discontinuity in the list of discontinuities found
  std::size_t leaves = 0;  // number of quadtree leaves whose interior the discontinuity crosses
  std::vector<OmittedPart> parts;
};

// The active DSets of one patch: the pairs of discontinuity line and quadtree leaf that give edges of the
// mesh.
struct PatchDSets {
  // The lines of those discontinuities that are mesh edges, in the order in which the edges were chosen.
  std::vector<DiscontinuityLine> lines;
  std::vector<ElementId> leaves;  // quadtree leaves of the patch, in depth-first order
  // For each quadtree leaf, the ascending indices in `lines` of those discontinuity lines that are mesh edges
  // in the leaf or along the border of the leaf.
  std::vector<std::vector<std::int32_t>> leaf_lines;
  std::size_t activated = 0;  // number of discontinuities that are mesh edges (active)
  // The number of DSets, pairs of line and leaf, whose line crosses the interior of the leaf.
  std::size_t dsets_active = 0;
  // The number of discontinuities that are no mesh edges because a leaf already had the largest number of
  // lines.
  std::size_t refused = 0;
  // The number of contacts that are no mesh edges because a leaf already had the largest number of lines.
  std::size_t refused_contacts = 0;
  // The largest number of discontinuities that lie on one mesh edge in a leaf, because they are collinear.
  std::size_t most_merged = 0;
  // The quadtree leaves, in ascending order, that kept a discontinuity from becoming a mesh edge because they
  // already had the largest allowed number of discontinuity lines. A leaf is listed in `crowded` only if the
  // omitted discontinuity is a contact with another surface, or if at most half the leaves that the
  // discontinuity crosses already had the largest number of lines.
  std::vector<ElementId> crowded;
  // The omitted discontinuities along which refinement may request mesh edges. Refinement may request an edge
  // along a discontinuity if, on some leaf, the error of the mesh without an edge along the discontinuity
  // (OmissionCost) is at least options.min_wanted_weight.
  std::vector<OmittedDiscontinuity> omitted;
};

// A function that returns the factor by which errors of irradiance on a quadtree leaf are multiplied before
// they are compared, for example a larger factor for a darker leaf. An empty ErrorScale function stands for
// the factor 1.
using ErrorScale = std::function<double(ElementId)>;
// A function that returns the factor by which errors of irradiance at a point of a quadtree leaf are
// multiplied before they are compared. The point passed to a PlaceScale is given in the frame of the patch
// [m].
using PlaceScale = std::function<double(ElementId, const Vec2&)>;

// Functions by which the caller modifies the choice of discontinuities. Each function in ActivationRules may
// be empty.
struct ActivationRules {
  // The filter decides in which quadtree leaves a discontinuity may become a mesh edge
  // (DiscontinuityChoiceMethod::FilterOf).
  LeafFilter filter = {};
  // The factor by which errors of irradiance on a quadtree leaf are multiplied before they are compared.
  ErrorScale scale = {};
  // The factor by which errors of irradiance at a point are multiplied, in place of `scale`, in leaves that
  // are crossed by more than max_leaf_dsets lines of sufficient weight.
  PlaceScale at_place = {};
};

// Activates discontinuities, that is, makes them edges of the mesh: first the contacts, then the others in
// order of decreasing weight. Without a filter, a discontinuity becomes active (an edge) on all quadtree
// leaves that the discontinuity meets, or on no leaf (thesis 5.5.7).
//  (1) Only discontinuities with weight >= options.min_weight, and those along which refinement has requested
//   edges, become active. If options.weight is kIrradiance, the weight of a discontinuity is the error of a
//   mesh that has the edges chosen so far, but no edge along this discontinuity (OmissionCost). Errors of
//   irradiance on a leaf are multiplied by rules.scale. In a leaf that more than options.max_leaf_dsets lines
//   of sufficient weight cross, errors are multiplied by rules.at_place (if not empty), so that lines in dark
//   places become edges first. A line may become an edge if its weight is at least options.min_weight with
//   errors multiplied by the larger of rules.scale and rules.at_place.
//  (2) At most options.max_leaf_dsets discontinuity lines cross the interior of any quadtree leaf.
//   Discontinuity lines along the border of a leaf do not count towards max_leaf_dsets, because they add no
//   edge to the leaf.
//  (3) The discontinuity of the largest weight becomes active (an edge) first. Discontinuities of equal
//   weight become active (edges) in their order in the list `found`.
// The method with the name options.choice may rank discontinuities by other numbers than their weights, and
// may allow another number of lines in a leaf than options.max_leaf_dsets. If rules.filter is not empty, the
// filter decides for each quadtree leaf separately which discontinuities may become mesh edges. With a
// filter, a discontinuity becomes active (an edge) on those leaves that pass the filter and have fewer than
// the largest allowed number of lines. REQUIRES: the patch's quadtree is balanced, and `found` contains
// discontinuities on this patch. REQUIRES: rules.filter is the result of FilterOf() of the method with the
// name options.choice. Throws InputError if there is no method with the name options.choice.
PatchDSets ActivateDiscontinuities(const ElementForest& forest, PatchId patch,
                                   std::span<const Discontinuity> found, const DiscontinuityOptions& options,
                                   const ActivationRules& rules = {});

}  // namespace penumbra
