// mesh/discontinuities/none_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Chooses no discontinuity: only leaves form the mesh.
DiscontinuityChoiceRegistry::Method NoneChoiceMethod();

}  // namespace penumbra
