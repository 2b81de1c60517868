// mesh/discontinuities/dset.h
//
// DSets (thesis 5.5.4-5.5.7): which discontinuities of a patch become edges of its leaves' triangulations. A
// DSet is a line together with those of its discontinuities that impinge on one leaf, and gives the leaf at
// most one edge.
//
// Where the thesis keeps DSets in every tree node and passes them down when a node splits, the lines of a
// patch are found once, here, when the quadtree is final, and leaves refer to them by number.

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

// A discontinuity too light to be active, with its parts on those leaves that have no edge along its line.
struct OmittedDiscontinuity {
  std::size_t number = 0;  // of those that were found
  std::size_t leaves = 0;  // whose inside it crosses
  std::vector<OmittedPart> parts;
};

// The active DSets of one patch.
struct PatchDSets {
  std::vector<DiscontinuityLine> lines;  // those with an active discontinuity, strongest first
  std::vector<ElementId> leaves;         // of the patch, depth first
  std::vector<std::vector<std::int32_t>>
      leaf_lines;                    // per leaf, ascending: lines active on it or along its border
  std::size_t activated = 0;         // discontinuities
  std::size_t dsets_active = 0;      // DSets that cross the inside of their leaf
  std::size_t refused = 0;           // discontinuities that would have crowded a leaf
  std::size_t refused_contacts = 0;  // of these, contacts
  std::size_t most_merged = 0;       // active discontinuities in one DSet, at most
  // Leaves for whose sake a discontinuity was refused everywhere: they were full, and at most as many as
  // those with room for it; or it was a contact. Ascending.
  std::vector<ElementId> crowded;
  // What refinement may ask for, where leaving it out costs at least options.min_wanted_weight.
  std::vector<OmittedDiscontinuity> omitted;
};

// How many times an error on a leaf counts; once without.
using ErrorScale = std::function<double(ElementId)>;
// The same at a place in a leaf, in the frame of the patch [m].
using PlaceScale = std::function<double(ElementId, const Vec2&)>;

// What a caller may add to the weights of discontinuities; all of it may be empty.
struct ActivationRules {
  LeafFilter filter = {};    // of the method of choice (DiscontinuityChoiceMethod::FilterOf)
  ErrorScale scale = {};     // on each leaf
  PlaceScale at_place = {};  // in leaves that have room for fewer lines than weigh enough
};

// Activates the discontinuities in order of weight, contacts first, each for all leaves on which it impinges
// or for none (thesis 5.5.7).
//  (1) An active discontinuity weighs at least options.min_weight, or is wanted. In the irradiance weight it
//  weighs what leaving its line out would cost beside those that are active already (OmissionCost), on each
//  leaf `rules.scale` times. If `rules.at_place` is given, it orders those in leaves that have room for
//  fewer lines than weigh enough; what weighs enough by either is tried.
//  (2) At most options.max_leaf_dsets lines run through the inside of any leaf. Those along a leaf's border
//  add no edge and do not count.
//  (3) The heaviest come first; of equal weight, the one found first.
// options.choice may change this: its method may put other ranks in place of the weights of (1) and (3), and
// another number in place of that of (2). If there is a filter, each leaf that the filter lets pass takes
// what has room there, whatever becomes of other leaves. REQUIRES: the patch's quadtree is balanced; `found`
// are discontinuities on this patch; the filter is that of the method (DiscontinuityChoiceMethod::FilterOf).
// Throws InputError if there is no such choice.
PatchDSets ActivateDiscontinuities(const ElementForest& forest, PatchId patch,
                                   std::span<const Discontinuity> found, const DiscontinuityOptions& options,
                                   const ActivationRules& rules = {});

}  // namespace penumbra
