// solver/transport/form_factors/single_plane.h

#pragma once

#include <vector>

#include "solver/transport/form_factors/plane_grid.h"
#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// (half the side of the plane) / (its height above the point), b. A part (1/2 + 1/pi) / b^2 of the flux, 0.4
// %, passes below the plane's edges; the literature says 2 / b^2, 1 %.
inline constexpr double kPlaneBreadth = 14;

// One plane above the point (Sillion and Puech 1989; Ashdown 1994, 5.21).
std::vector<PlaneGrid> SinglePlane(int resolution, CellRule rule = CellRule::kExact);

// The method `single-plane`: 512 cells along a side unless the options say otherwise. Light from near the
// horizon is lost.
LinkFormFactorRegistry::Method SinglePlaneMethod();

}  // namespace penumbra
