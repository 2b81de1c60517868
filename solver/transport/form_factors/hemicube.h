// solver/transport/form_factors/hemicube.h

#pragma once

#include <vector>

#include "solver/transport/form_factors/plane_grid.h"
#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The top and the four sides of a hemicube (Cohen and Greenberg 1985; Ashdown 1994, 5.7). The top has
// resolution x resolution cells, a side half of them. The resolution is rounded up to an even number.
std::vector<PlaneGrid> HemicubePlanes(int resolution, CellRule rule = CellRule::kExact);

// The method `hemicube`: 100 cells along a side unless the options say otherwise.
LinkFormFactorRegistry::Method HemicubeMethod();

}  // namespace penumbra
