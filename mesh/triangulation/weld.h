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

// Adds to each patch's outline the vertices of other patches that lie on this outline. If vertices of two
// patches lie within the snap distance of each other, both get the position of the vertex of the patch with
// the lower number. If cancelled, the borders are useless. REQUIRES: borders[i] are the borders of patch i.
void WeldOutlines(const Scene& scene, std::span<PatchBorders> borders,
                  const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
