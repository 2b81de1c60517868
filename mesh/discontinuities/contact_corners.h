// mesh/discontinuities/contact_corners.h
//
// The ends of contacts (thesis 4.4.2, drawback 2). Near the end of a contact, the irradiance depends on the
// direction in which a point approaches the end, and no polynomial fits the irradiance. At the end of a
// contact, each adjacent triangle therefore has its own value of the irradiance. Dividing the leaves towards
// the end of a contact reduces the area where the separate values do not suffice.

#pragma once

#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

// The ends of the contacts among `found`, in the patch's frame [m]. Ends of contacts that lie within
// SnapDistance() of each other count as one.
std::vector<Vec2> ContactEnds(const Patch& patch, std::span<const Discontinuity> found);

// For each point of `ends`, divides the leaf that contains the point, `divisions` times in succession, and
// then balances the quadtree. No leaf becomes smaller than `min_area` [m^2].
void DivideTowards(std::span<const Vec2> ends, int divisions, double min_area, PatchId patch,
                   ElementForest& forest);

}  // namespace penumbra
