// mesh/discontinuities/dset.h
//
// DSets (thesis 5.5.4-5.5.7) determine which discontinuities of a patch become edges of the leaves'
// triangulations. A DSet is a pair of a line and a leaf: the line's discontinuities that impinge on the leaf.
// A DSet gives the leaf at most one edge.
//
// The thesis stores DSets in every node of the quadtree and passes them on when a node splits. Here, a
// patch's lines are found once, when the quadtree is final; leaves refer to lines by number.

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

// An inactive discontinuity of too little weight, with its parts on the leaves that have no edge along its
// line.
struct OmittedDiscontinuity {
  std::size_t number = 0;  // index in the list of discontinuities found
  std::size_t leaves = 0;  // number of leaves whose interior it crosses
  std::vector<OmittedPart> parts;
};

// The active DSets of one patch.
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
  // The full leaves because of which all leaves refused a discontinuity, ascending. A refusal counts only if
  // it concerns a contact, or if at most as many leaves were full as had room for the discontinuity.
  std::vector<ElementId> crowded;
  // The discontinuities that refinement may request: on some leaf, omission costs at least
  // options.min_wanted_weight.
  std::vector<OmittedDiscontinuity> omitted;
};

// The factor of errors on a leaf; without a function the factor is 1.
using ErrorScale = std::function<double(ElementId)>;
// The factor of errors at a point of a leaf, in the frame of the patch [m].
using PlaceScale = std::function<double(ElementId, const Vec2&)>;

// Additions of the caller to the weights of discontinuities. Each may be empty.
struct ActivationRules {
  LeafFilter filter = {};    // of the method of choice (DiscontinuityChoiceMethod::FilterOf)
  ErrorScale scale = {};     // factor of errors on each leaf
  PlaceScale at_place = {};  // factor in leaves where more lines of sufficient weight compete than have room
};

// Activates the discontinuities in the order of their weights, contacts first. A discontinuity becomes active
// on all leaves on which it impinges, or on none (thesis 5.5.7).
//  (1) An active discontinuity weighs at least options.min_weight, or is wanted. With the irradiance weight,
//   the weight is the cost of omitting the discontinuity's line from the mesh with the lines active so far
//   (OmissionCost); `rules.scale` multiplies the errors of each leaf. In leaves where more lines of
//   sufficient weight compete than have room, `rules.at_place`, if given, replaces `rules.scale` in the
//   order. A discontinuity takes part if either factor gives it sufficient weight.
//  (2) At most options.max_leaf_dsets lines cross the interior of any leaf. Lines along a leaf's border add
//   no edge and do not count.
//  (3) The heaviest come first. Of discontinuities with equal weight, the first of `found` comes first.
// The method options.choice may replace the weights in (1) and (3) by ranks, and the limit in (2) by another.
// With a filter, each leaf that passes the filter takes the discontinuities that it has room for,
// independently of other leaves. REQUIRES: the patch's quadtree is balanced; `found` are discontinuities on
// this patch; the filter is that of the method (DiscontinuityChoiceMethod::FilterOf). Throws InputError if no
// method is called options.choice.
PatchDSets ActivateDiscontinuities(const ElementForest& forest, PatchId patch,
                                   std::span<const Discontinuity> found, const DiscontinuityOptions& options,
                                   const ActivationRules& rules = {});

}  // namespace penumbra
