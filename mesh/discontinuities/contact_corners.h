// mesh/discontinuities/contact_corners.h
//
// Refines the quadtree at the ends of contacts, the segments where another surface touches a patch (thesis
// 4.4.2, drawback 2). Near the end of a line where surfaces touch, the irradiance depends on the direction in
// which a point approaches the end, and no polynomial fits the irradiance. Triangles of the mesh that meet at
// the end of a contact have separate values of the irradiance at this vertex. Dividing the quadtree leaves at
// the end of a contact reduces the area where the interpolants remain inaccurate.

#pragma once

#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

// Returns the ends of the contacts (lines where surfaces touch) in `found`, in the patch's frame [m]. Ends of
// contacts that lie within SnapDistance() of each other count as one.
std::vector<Vec2> ContactEnds(const Patch& patch, std::span<const Discontinuity> found);

// For each point in `ends`, divides the quadtree leaf that contains the point, then the child that contains
// the point, and so on, `divisions` times. After the divisions, DivideTowards() balances the quadtree, so
// that the levels of leaves that share an edge differ by at most one. No quadtree leaf becomes smaller than
// `min_area` [m^2].
void DivideTowards(std::span<const Vec2> ends, int divisions, double min_area, PatchId patch,
                   ElementForest& forest);

}  // namespace penumbra
