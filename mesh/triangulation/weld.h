// mesh/triangulation/weld.h
//
// One set of vertices on the edges that patches share, so that no T-vertex is left between patches
// (thesis 3.6, case C).

#pragma once

#include <span>

#include "mesh/triangulation/patch_borders.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Gives each patch the vertices that others have on its outline. Where two have one within the snap distance
// of each other, both take the position of the lower patch, to the bit. REQUIRES: borders[i] are those of
// patch i.
void WeldOutlines(const Scene& scene, std::span<PatchBorders> borders);

}  // namespace penumbra
