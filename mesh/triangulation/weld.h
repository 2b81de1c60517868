// mesh/triangulation/weld.h
//
// Common vertices on the edges that patches share, so that no T-vertex remains between patches (thesis 3.6,
// case C).

#pragma once

#include <span>

#include "mesh/triangulation/patch_borders.h"
#include "solver/base/progress.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Adds to each patch's outline the vertices that other patches have there. Where two patches have vertices
// within the snap distance of each other, both get the exact position of the patch with the lower number.
// Of no use if cancelled. REQUIRES: borders[i] are the borders of patch i.
void WeldOutlines(const Scene& scene, std::span<PatchBorders> borders,
                  const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
