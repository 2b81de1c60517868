// mesh/discontinuities/none_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// None: the mesh has the leaves alone.
DiscontinuityChoiceRegistry::Method NoneChoiceMethod();

}  // namespace penumbra
