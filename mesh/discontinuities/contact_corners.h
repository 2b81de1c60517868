// mesh/discontinuities/contact_corners.h
//
// Where contact edges end (thesis 4.4.2, drawback 2): there the irradiance depends on the direction in which
// one comes near, and no polynomial fits. Each triangle has a value of its own at such a corner; leaves
// graded towards it make the area small on which that is not enough.

#pragma once

#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

// The ends of the contacts among the discontinuities of a patch, in its frame [m]; each once.
std::vector<Vec2> ContactEnds(const Patch& patch, std::span<const Discontinuity> found);

// Divides so many times those leaves of the patch that hold one of the ends, and balances its quadtree. No
// leaf becomes smaller than the area [m^2].
void DivideTowards(std::span<const Vec2> ends, int divisions, double min_area, PatchId patch,
                   ElementForest& forest);

}  // namespace penumbra
