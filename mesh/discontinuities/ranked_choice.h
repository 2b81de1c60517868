// mesh/discontinuities/ranked_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// The heaviest, as many as a leaf may have (thesis 5.5.7).
DiscontinuityChoiceRegistry::Method RankedChoiceMethod();

}  // namespace penumbra
