// solver/transport/points/free_area.h
//
// The free area of each patch. A box on a floor covers a part of the floor that no light reaches. The sum of
// the floor's form factors is therefore free area / area, not 1.

#pragma once

#include <vector>

#include "solver/base/progress.h"
#include "solver/scene/scene.h"

namespace penumbra {

// For each patch, the total area of those parts between its contacts that see the front of another patch
// [m^2]. Exact, except for slivers that CutLeavesAtContacts() does not cut off and for light through gaps
// that count as closed (ContactGap). In an open scene, a part that sees only the sky does not count as free.
// Parallel; the result does not depend on the number of threads. The result is useless if the context is
// cancelled.
std::vector<double> FreeAreas(const Scene& scene, const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
