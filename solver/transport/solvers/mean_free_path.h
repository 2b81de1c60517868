// solver/transport/solvers/mean_free_path.h

#pragma once

#include "solver/scene/scene.h"

namespace penumbra {

// The mean length of diffuse rays between fronts of the scene [m], from some thousand low-discrepancy rays:
// the typical size of a room, however many rooms there are. In a closed room, it is 4 volume / surface area.
// If fewer than a tenth of the rays meet a front, the result is the diagonal of the scene. 0 without patches.
double MeanFreePath(const Scene& scene);

}  // namespace penumbra
