// solver/transport/form_factors/two_planes.h

#pragma once

#include <vector>

#include "solver/transport/form_factors/plane_grid.h"
#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// A broad plane, as SinglePlane(), with finer cells where it is near (Recker, George and Greenberg 1990;
// Ashdown 1994, 5.21): an inner plane of a seventh of the side has resolution x resolution cells, and so has
// the outer plane, whose cells behind the inner one count as empty. The resolution is rounded up to a
// multiple of 14.
std::vector<PlaneGrid> TwoPlanes(int resolution, CellRule rule = CellRule::kExact);

// The method `two-planes`: 112 cells along a side unless the options say otherwise.
LinkFormFactorRegistry::Method TwoPlanesMethod();

}  // namespace penumbra
