// solver/scene/convex_solids.h
//
// Finds boxes and other convex bodies among the patches. Seen from a point outside a convex body, a single
// outline bounds the region that all sides of the body together hide.

#pragma once

#include "solver/scene/scene.h"

namespace penumbra {

// Fills scene.solids and scene.solid_of from scene.patches. Patches form a solid if they share whole edges
// with exactly equal end points, if the fronts are convex or flat at every shared edge, and if the whole body
// is convex up to rounding errors. A side of a solid may be missing, such as the bottom of a box on a floor.
// Coplanar patches alone form no solid, except the front and the back of an infinitely thin sheet. Bodies
// with more than kMostSides sides or kMostCorners corners are not recorded.
void FindConvexSolids(Scene& scene);

inline constexpr std::size_t kMostSides = 16, kMostCorners = 28;

}  // namespace penumbra
