// solver/transport/points/free_area.h
//
// How much of each patch lies free. A box that stands on a floor covers a part of it, which light cannot
// reach: what the floor's form factors add up to is its free share, not 1.

#pragma once

#include <vector>

#include "solver/base/progress.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Per patch, the area of those parts between its contacts from which the fronts of other patches can be seen
// [m^2]. Exact but for slivers that are not cut off (CutLeavesAtContacts) and for what light comes through
// gaps that count as closed (ContactGap). In an open scene a part that looks at nothing but the sky is not
// free by this. Parallel, and the same for any number of threads.
// Of no use if it was cancelled.
std::vector<double> FreeAreas(const Scene& scene, const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
