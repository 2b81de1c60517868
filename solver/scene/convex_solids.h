// solver/scene/convex_solids.h
//
// Boxes and other convex bodies among the patches: from outside, one outline tells what all their sides hide.

#pragma once

#include "solver/scene/scene.h"

namespace penumbra {

// Fills scene.solids and scene.solid_of from scene.patches. Patches that share whole edges, to the bit, at
// which their fronts bend away from each other or lie in one plane form a solid, if it is convex but for
// rounding. Planar sides may be missing. Pieces of one plane are none, but for the front and the back of a
// sheet. What has more sides or corners than these stays without.
void FindConvexSolids(Scene& scene);

inline constexpr std::size_t kMostSides = 16, kMostCorners = 28;

}  // namespace penumbra
