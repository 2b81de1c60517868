// solver/transport/solvers/closure.h
//
// The closure of a leaf (undivided element of a quadtree) is the correct sum of its form factors to all other
// surfaces. In nearly white rooms, light bounces a thousand times, and an error of 1/1000 in the sum of the
// form factors doubles or halves the light. In nearly white rooms, the form factors of links (hierarchical
// interactions between elements) are scaled so that their sum at a leaf equals the leaf's closure
// (PushPull::Balance).

#pragma once

#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/element_forest.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// For each leaf, the fraction of the diffuse light leaving the leaf's front that meets fronts of other
// patches [1]. In a closed room, the closure (sum of form factors) of a leaf is 1 - (covered area) / area, up
// to rounding. Contacts (segments where other surfaces touch the leaf) divide the leaf into parts
// (CutLeavesAtContacts). The closure (sum of form factors) is computed exactly for the centroid of each part
// of a leaf, and is assumed to be constant over the part. If the computation is cancelled (ExecutionContext),
// the computed closures (sums of form factors) must not be used.
std::vector<double> LeafClosures(const ElementForest& forest, const PatchVisibility& visibility,
                                 std::span<const ElementId> leaves, const ExecutionContext& context);

}  // namespace penumbra
