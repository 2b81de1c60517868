// mesh/discontinuities/ranked_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Chooses discontinuities in order of decreasing weight, until quadtree leaves have no more room (thesis
// 5.5.7).
DiscontinuityChoiceRegistry::Method RankedChoiceMethod();

}  // namespace penumbra
