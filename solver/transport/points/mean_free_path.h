// solver/transport/points/mean_free_path.h

#pragma once

#include "solver/scene/scene.h"

namespace penumbra {

// The mean length of diffuse rays between fronts of the scene [m], from some thousand low-discrepancy rays:
// the typical size of a room of the scene. In a closed room, the mean free path is 4 * volume / (surface
// area). If fewer than a tenth of the rays meet a front, MeanFreePath() returns the diagonal of the scene's
// bounding box. The mean free path of a scene without patches is 0.
double MeanFreePath(const Scene& scene);

}  // namespace penumbra
