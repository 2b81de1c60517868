// mesh/discontinuities/adaptive_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Adaptive discontinuity meshing (Stuerzlinger 1994): chooses the discontinuities that cross a leaf whose
// corners see different parts of the source, the heaviest first. A full leaf refuses a discontinuity for
// itself only; other leaves may still take the discontinuity.
DiscontinuityChoiceRegistry::Method AdaptiveChoiceMethod();

}  // namespace penumbra
