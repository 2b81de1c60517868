// solver/transport/form_factors/two_planes.h

#pragma once

#include <vector>

#include "solver/transport/form_factors/plane_grid.h"
#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// A broad plane above the point, as in SinglePlane(), with smaller cells around its centre (Recker, George
// and Greenberg 1990; Ashdown 1994, 5.21). The inner plane has a seventh of the outer plane's side; each of
// the two planes has resolution x resolution cells. Cells of the outer plane that the inner plane covers have
// form factor 0. The resolution of the two planes is rounded up to a multiple of 14.
std::vector<PlaneGrid> TwoPlanes(int resolution, CellRule rule = CellRule::kExact);

// The form-factor method `two-planes`, by default with 112 cells along a side of each of the two planes.
LinkFormFactorRegistry::Method TwoPlanesMethod();

}  // namespace penumbra
