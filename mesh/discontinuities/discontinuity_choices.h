// mesh/discontinuities/discontinuity_choices.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// The registry of all methods that choose discontinuities. The first method in the registry is the default
// choice of discontinuities.
DiscontinuityChoiceRegistry& DiscontinuityChoices();

}  // namespace penumbra
