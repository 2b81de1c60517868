// mesh/discontinuities/none_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Chooses no discontinuity, so that the mesh has only the edges that its quadtree leaves require.
DiscontinuityChoiceRegistry::Method NoneChoiceMethod();

}  // namespace penumbra
