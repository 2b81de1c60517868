// mesh/discontinuities/adaptive_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Those that cross a leaf whose corners see different parts of the source (Stuerzlinger 1994), the heaviest
// first; a leaf that is full refuses what other leaves may take.
DiscontinuityChoiceRegistry::Method AdaptiveChoiceMethod();

}  // namespace penumbra
