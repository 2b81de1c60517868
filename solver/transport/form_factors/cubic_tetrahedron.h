// solver/transport/form_factors/cubic_tetrahedron.h

#pragma once

#include <vector>

#include "solver/transport/form_factors/plane_grid.h"
#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The three triangular faces of a cube's corner that stands above the point, its diagonal along the normal
// (Beran-Koehn and Pavicic 1991; Ashdown 1994, 5.8). Each face spans [-2, 1] x [-2, 1] with resolution x
// resolution cells, of which half lie above the horizon. The horizon halves the cells along the diagonal.
std::vector<PlaneGrid> CubicTetrahedronPlanes(int resolution, CellRule rule = CellRule::kExact);

// The method `cubic-tetrahedron`: 142 cells along a side unless the options say otherwise, about as many
// cells as a hemicube of 100.
LinkFormFactorRegistry::Method CubicTetrahedronMethod();

}  // namespace penumbra
