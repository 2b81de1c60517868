// solver/transport/solvers/closure.h
//
// How much of what a surface sends out the scene takes up again: the sums that the rows of form factors must
// have. In rooms that are nearly white light bounces a thousand times, and a row that is off by one in a
// thousand doubles it or halves it: there the links are brought into balance by these (PushPull::Balance).

#pragma once

#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/element_forest.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// The share of what the front of each of these leaves would send out evenly that meets fronts of the scene
// [1]: in a closed room 1, to rounding, less what covers the leaf. Exact at the centroids of the leaf's parts
// between contacts (CutLeavesAtContacts), which stand for their parts. Of no use if it was cancelled.
std::vector<double> LeafClosures(const ElementForest& forest, const PatchVisibility& visibility,
                                 std::span<const ElementId> leaves, const ExecutionContext& context);

}  // namespace penumbra
