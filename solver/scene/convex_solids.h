// solver/scene/convex_solids.h
//
// Finds boxes and other convex bodies among the patches. Seen from a point outside a convex body, a single
// outline bounds the region that all sides of the body hide together.

#pragma once

#include "solver/scene/scene.h"

namespace penumbra {

// Fills scene.solids and scene.solid_of from scene.patches. Patches form a solid if they share whole edges,
// with exactly equal end points; if their fronts are convex or flat at every shared edge; and if the whole
// body is convex to within rounding errors. A side of the body may be missing. Coplanar patches alone are no
// solid, except the front and the back of a sheet. Bodies with more than kMostSides sides or kMostCorners
// corners are not recorded.
void FindConvexSolids(Scene& scene);

inline constexpr std::size_t kMostSides = 16, kMostCorners = 28;

}  // namespace penumbra
