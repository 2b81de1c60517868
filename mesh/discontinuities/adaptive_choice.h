// mesh/discontinuities/adaptive_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Adaptive discontinuity meshing (Stuerzlinger 1994): chooses, in order of decreasing weight, the
// discontinuities that cross a quadtree leaf from whose corners different parts of the light source are
// visible. If a quadtree leaf has no room for a discontinuity, other leaves may still use the discontinuity
// as an edge.
DiscontinuityChoiceRegistry::Method AdaptiveChoiceMethod();

}  // namespace penumbra
