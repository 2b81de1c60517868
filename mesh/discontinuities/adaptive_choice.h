// mesh/discontinuities/adaptive_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Adaptive discontinuity meshing (Stuerzlinger 1994): chooses the discontinuities that cross a leaf whose
// corners see different parts of the source, in order of decreasing weight. If a leaf has no room for a
// discontinuity, other leaves may still use it as an edge.
DiscontinuityChoiceRegistry::Method AdaptiveChoiceMethod();

}  // namespace penumbra
