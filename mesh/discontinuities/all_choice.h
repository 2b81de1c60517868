// mesh/discontinuities/all_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Chooses all discontinuities, without a limit to the number in one leaf.
DiscontinuityChoiceRegistry::Method AllChoiceMethod();

}  // namespace penumbra
