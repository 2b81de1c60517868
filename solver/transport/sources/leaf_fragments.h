// solver/transport/sources/leaf_fragments.h
//
// Cuts leaves where other patches touch them. A quadtree cannot follow the foot of a box that stands askew on
// the floor: the leaf below has one radiosity for its lit and its covered part, and the foot sees that from
// nearest by. Fragments give each side its own.

#pragma once

#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// The fragments of all leaves that a contact crosses, without light, by leaf. Each leaf's fragments are
// convex and tile it. Of no use if it was cancelled.
std::vector<Fragment> CutLeavesAtContacts(const ElementForest& forest,
                                          const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
