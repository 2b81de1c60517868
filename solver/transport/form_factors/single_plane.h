// solver/transport/form_factors/single_plane.h

#pragma once

#include <vector>

#include "solver/transport/form_factors/plane_grid.h"
#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The ratio b = (half the side of the plane) / (height of the plane above the point). Below the edges of a
// plane with ratio b = 14, the fraction (1/2 + 1/pi) / b^2 = 0.4 % of the point's diffuse flux is lost. The
// literature gives a lost fraction of 2 / b^2 = 1 % for b = (half the side) / (height) = 14.
inline constexpr double kPlaneBreadth = 14;

// A single plane above the point, for projected form factors (Sillion and Puech 1989; Ashdown 1994, 5.21).
std::vector<PlaneGrid> SinglePlane(int resolution, CellRule rule = CellRule::kExact);

// The form-factor method `single-plane`, by default with 512 cells along a side of the plane. Light from
// directions near the horizon misses the plane and is lost.
LinkFormFactorRegistry::Method SinglePlaneMethod();

}  // namespace penumbra
