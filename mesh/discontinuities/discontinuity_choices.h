// mesh/discontinuities/discontinuity_choices.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// The registry of all methods that choose discontinuities. The first is the default.
DiscontinuityChoiceRegistry& DiscontinuityChoices();

}  // namespace penumbra
