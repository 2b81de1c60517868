// solver/transport/form_factors/hemicube.h

#pragma once

#include <vector>

#include "solver/transport/form_factors/plane_grid.h"
#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The top and the four sides of a hemicube (Cohen and Greenberg 1985; Ashdown 1994, 5.7). The top of the
// hemicube has resolution x resolution cells; each of the four sides has half as many cells as the top. The
// resolution of the hemicube is rounded up to an even number.
std::vector<PlaneGrid> HemicubePlanes(int resolution, CellRule rule = CellRule::kExact);

// The form-factor method `hemicube`, by default with 100 x 100 cells in the top of the hemicube.
LinkFormFactorRegistry::Method HemicubeMethod();

}  // namespace penumbra
