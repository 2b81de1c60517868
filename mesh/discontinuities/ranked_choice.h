// mesh/discontinuities/ranked_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Chooses discontinuities in order of decreasing weight, up to the largest number of lines in a quadtree leaf
// (thesis 5.5.7).
DiscontinuityChoiceRegistry::Method RankedChoiceMethod();

}  // namespace penumbra
