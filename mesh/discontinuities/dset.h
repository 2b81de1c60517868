// mesh/discontinuities/dset.h
//
// DSets (thesis 5.5.4-5.5.7) determine which discontinuities of a patch become edges of the leaves'
// triangulations. A DSet is a pair of a line and a leaf: the discontinuities on the line that meet the leaf.
// Each DSet contributes at most one edge to the leaf's triangulation.
//
// The thesis stores DSets in every node of the quadtree and passes them on when a node splits. In this
// implementation, the lines of a patch are found once, when the quadtree is final; leaves refer to lines by
// number.

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

// A discontinuity that is not active because its weight is too small, with its parts on leaves that have no
// edge along its line.
struct OmittedDiscontinuity {
  std::size_t number = 0;  // index in the list of discontinuities found
  std::size_t leaves = 0;  // number of leaves whose interior it crosses
  std::vector<OmittedPart> parts;
};

// The active DSets of one patch: the pairs of line and leaf that give edges of the mesh.
struct PatchDSets {
  std::vector<DiscontinuityLine> lines;  // lines with an active discontinuity, in the order of activation
  std::vector<ElementId> leaves;         // of the patch, depth first
  std::vector<std::vector<std::int32_t>>
      leaf_lines;                    // per leaf, ascending: lines active in the leaf or along its border
  std::size_t activated = 0;         // number of active discontinuities
  std::size_t dsets_active = 0;      // DSets that cross the interior of their leaf
  std::size_t refused = 0;           // discontinuities that no leaf took because leaves were full
  std::size_t refused_contacts = 0;  // of these, contacts
  std::size_t most_merged = 0;       // largest number of active discontinuities in one DSet
  // The leaves that had no room for a discontinuity, so that it was refused on all leaves; in ascending
  // order. Leaves are listed only if the refused discontinuity is a contact, or if (number of leaves without
  // room) <= (number of leaves with room).
  std::vector<ElementId> crowded;
  // The omitted discontinuities that refinement may request: on at least one leaf, the cost of omission is at
  // least options.min_wanted_weight.
  std::vector<OmittedDiscontinuity> omitted;
};

// A function that returns the factor by which errors on a leaf are multiplied. An empty function stands for
// the factor 1.
using ErrorScale = std::function<double(ElementId)>;
// A function that returns the factor by which errors at a point of a leaf are multiplied. The point is given
// in the frame of the patch [m].
using PlaceScale = std::function<double(ElementId, const Vec2&)>;

// Functions by which the caller modifies the choice of discontinuities. Each function may be empty.
struct ActivationRules {
  LeafFilter filter = {};    // of the method of choice (DiscontinuityChoiceMethod::FilterOf)
  ErrorScale scale = {};     // factor of errors on each leaf
  PlaceScale at_place = {};  // factor in leaves where more lines of sufficient weight compete than have room
};

// Activates discontinuities, that is, makes them edges of the mesh: first the contacts, then the others in
// order of decreasing weight. A discontinuity becomes active on all leaves that it meets, or on none (thesis
// 5.5.7).
//  (1) Only discontinuities with weight >= options.min_weight, and those that are `wanted`, become active. If
//   options.weight is kIrradiance, the weight is the cost of omitting the discontinuity's line from the mesh
//   with the lines that are already active (OmissionCost). The errors on each leaf are multiplied by
//   `rules.scale`. If a leaf has too little room for all lines of sufficient weight, `rules.at_place`, if not
//   empty, replaces `rules.scale` when the order is determined. The weight is sufficient if it is at least
//   options.min_weight with rules.scale or with rules.at_place.
//  (2) At most options.max_leaf_dsets lines cross the interior of any leaf. Lines along the border of a leaf
//   add no edge and are not counted.
//  (3) The discontinuity of the largest weight becomes active first. Discontinuities of equal weight follow
//  the order of `found`.
// The method options.choice may replace the weights in (1) and (3) by ranks, and the limit in (2) by another.
// If rules.filter is not empty, it decides for each leaf separately: a discontinuity becomes active on those
// leaves that pass the filter and have room for the discontinuity. REQUIRES: the patch's quadtree is
// balanced; `found` contains discontinuities on this patch; rules.filter is the result of FilterOf() of the
// method options.choice. Throws InputError if there is no method with the name options.choice.
PatchDSets ActivateDiscontinuities(const ElementForest& forest, PatchId patch,
                                   std::span<const Discontinuity> found, const DiscontinuityOptions& options,
                                   const ActivationRules& rules = {});

}  // namespace penumbra
