// mesh/triangulation/weld.h
//
// Gives patches that share an edge the same vertices on the edge, so that no T-vertex remains between the
// patches (thesis 3.6, case C).

#pragma once

#include <span>

#include "mesh/triangulation/patch_borders.h"
#include "solver/base/progress.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Adds to each patch's outline the vertices of other patches that lie on this outline. If vertices of two
// patches lie within SnapDistance() of each other, both vertices move to the position of the vertex of the
// patch with the lower number. If the computation is cancelled, `borders` must not be used afterwards.
// REQUIRES: borders[i] holds the borders of the leaves of patch i.
void WeldOutlines(const Scene& scene, std::span<PatchBorders> borders,
                  const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
