// solver/transport/form_factors/cubic_tetrahedron.h

#pragma once

#include <vector>

#include "solver/transport/form_factors/plane_grid.h"
#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The three faces of a cubic tetrahedron: the corner of a cube above a point, with the cube's diagonal along
// the surface normal (Beran-Koehn and Pavicic 1991; Ashdown 1994, 5.8). Each face of the cubic tetrahedron
// spans [-2, 1] x [-2, 1] with resolution x resolution cells, of which half lie above the horizon. The
// horizon cuts the cells along the face's diagonal into halves.
std::vector<PlaneGrid> CubicTetrahedronPlanes(int resolution, CellRule rule = CellRule::kExact);

// The form-factor method `cubic-tetrahedron`, by default with 142 cells along a side of each face. The
// default cubic tetrahedron has about as many cells as a hemicube of resolution 100.
LinkFormFactorRegistry::Method CubicTetrahedronMethod();

}  // namespace penumbra
