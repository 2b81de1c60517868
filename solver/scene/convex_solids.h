// solver/scene/convex_solids.h
//
// Finds boxes and other convex bodies among the patches. Seen from outside, one outline bounds what all sides
// of such a body hide.

#pragma once

#include "solver/scene/scene.h"

namespace penumbra {

// Fills scene.solids and scene.solid_of from scene.patches. Patches form a solid if they share whole edges,
// to the bit, at which their fronts bend away from each other or lie in one plane, and if the body is convex
// to rounding. Planar sides may be missing. Coplanar patches alone are no solid, except the front and the
// back of a sheet. Bodies with more than kMostSides sides or kMostCorners corners are not recorded.
void FindConvexSolids(Scene& scene);

inline constexpr std::size_t kMostSides = 16, kMostCorners = 28;

}  // namespace penumbra
