// mesh/discontinuities/adaptive_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Adaptive discontinuity meshing (Stuerzlinger 1994): chooses, in order of decreasing weight, the
// discontinuities that cross a quadtree leaf from whose corners different parts of the light source are
// visible. A discontinuity may become an edge in some leaves even if other leaves already have the largest
// number of lines.
DiscontinuityChoiceRegistry::Method AdaptiveChoiceMethod();

}  // namespace penumbra
