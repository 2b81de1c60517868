// mesh/discontinuities/ranked_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Chooses the heaviest discontinuities, as many as a leaf has room for (thesis 5.5.7).
DiscontinuityChoiceRegistry::Method RankedChoiceMethod();

}  // namespace penumbra
