// display/viewer/leaf_mesh.h

#pragma once

#include <span>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra::viewer {

// The leaves of a forest as triangles of constant irradiance [W/m^2]. `irradiance` is indexed by ElementId.
// The mesh can be made after any step of the solver, because no irradiance is computed and the forest need
// not be balanced. The mesh may have T-vertices; the display closes the gaps.
IrradianceMesh LeafMesh(const ElementForest& forest, std::span<const Rgb> irradiance);

}  // namespace penumbra::viewer
