// mesh/discontinuities/all_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Chooses all discontinuities as edges of the mesh, without a limit to their number in one quadtree leaf.
DiscontinuityChoiceRegistry::Method AllChoiceMethod();

}  // namespace penumbra
