// solver/transport/solvers/closure.h
//
// The closure of a leaf is the correct sum of its form factors. In nearly white rooms, light bounces a
// thousand times, and an error of 1/1000 in the sum of the form factors doubles or halves the light. In
// nearly white rooms, the form factors of links are scaled so that their sum equals the closure
// (PushPull::Balance).

#pragma once

#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/element_forest.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// For each leaf, the fraction of the diffuse light leaving its front that meets fronts of the scene [1]. In a
// closed room, the closure of a leaf is 1 - (covered area / area), up to rounding. Contacts divide the leaf
// into parts (CutLeavesAtContacts); the closure is computed exactly for the centroid of each part, and is
// assumed to be constant over the part. The result is useless if the context is cancelled.
std::vector<double> LeafClosures(const ElementForest& forest, const PatchVisibility& visibility,
                                 std::span<const ElementId> leaves, const ExecutionContext& context);

}  // namespace penumbra
