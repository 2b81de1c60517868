// solver/transport/sources/leaf_fragments.h
//
// Cuts leaves along contacts with other patches. A quadtree cannot follow the foot of a box that stands at an
// angle on the floor: without cuts, the leaf below the box has the same radiosity in its lit and in its
// covered part, and this wrong radiosity illuminates the sides of the box from close by. Fragments give the
// part on each side of a contact its own radiosity.

#pragma once

#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// The fragments of all leaves that a contact crosses, ordered by leaf; irradiances and radiosities are not
// set. The fragments of a leaf are convex and tile the leaf. The result is useless if the context is
// cancelled.
std::vector<Fragment> CutLeavesAtContacts(const ElementForest& forest,
                                          const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
