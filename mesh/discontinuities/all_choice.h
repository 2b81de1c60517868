// mesh/discontinuities/all_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// All, however many a leaf gets.
DiscontinuityChoiceRegistry::Method AllChoiceMethod();

}  // namespace penumbra
