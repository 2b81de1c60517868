// solver/transport/sources/leaf_fragments.h
//
// Cuts leaves (undivided quadtree elements) along contacts, the lines where other patches touch them. A
// quadtree cannot follow the foot of a box that stands at an angle on the floor: without cuts, the leaf below
// the box has the same radiosity in its lit part and in its covered part. Without cuts along contacts, the
// wrong radiosity of the leaf below a box illuminates the sides of the box from close by. Fragments, the
// parts of a cut leaf, have separate radiosities on the two sides of a contact.

#pragma once

#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// The fragments of all leaves that a contact crosses, ordered by leaf; CutLeavesAtContacts() does not set
// irradiance and radiosity of the fragments. The fragments of a leaf are convex and tile the leaf. If the
// computation is cancelled (ExecutionContext), the fragments must not be used.
std::vector<Fragment> CutLeavesAtContacts(const ElementForest& forest,
                                          const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
