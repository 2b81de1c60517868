// solver/transport/points/free_area.h
//
// The free area of each patch: the area that is not covered by other objects. For example, a box on a floor
// covers a part of the floor, which no light reaches; the sum of the floor's form factors is therefore (free
// area) / area instead of 1.

#pragma once

#include <vector>

#include "solver/base/progress.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Contacts divide a patch into parts. The free area of the patch is the total area of those parts that see
// the front of another patch [m^2]. The result is exact, except for slivers that CutLeavesAtContacts() does
// not cut off and for light through gaps that count as closed (ContactGap). In an open scene, the area of
// a part that sees only the sky is not counted. The function uses several threads; the result does not depend
// on their number. The result is useless if the context is cancelled.
std::vector<double> FreeAreas(const Scene& scene, const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
