// solver/transport/solvers/closure.h
//
// The closure of leaves: the correct sum of the form factors of each leaf. In rooms that are nearly white,
// light bounces a thousand times, and an error of 1/1000 in the sum doubles or halves the light. There the
// closures bring the links into balance (PushPull::Balance).

#pragma once

#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/element_forest.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// For each leaf, the fraction of the diffuse light leaving its front that meets fronts of the scene [1]. In a
// closed room it is 1, up to rounding, minus the covered fraction of the leaf. Exact at the centroids of the
// leaf's parts between contacts (CutLeavesAtContacts); each centroid stands for its part. The result is
// useless if the context is cancelled.
std::vector<double> LeafClosures(const ElementForest& forest, const PatchVisibility& visibility,
                                 std::span<const ElementId> leaves, const ExecutionContext& context);

}  // namespace penumbra
