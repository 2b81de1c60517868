// display/viewer/leaf_mesh.h

#pragma once

#include <span>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra::viewer {

// Makes a mesh of triangles of constant irradiance [W/m^2] from the leaves of all quadtrees. `irradiance` is
// indexed by ElementId. A leaf mesh can be made after any step of the solver, because no irradiance is
// computed and the quadtrees need not be balanced. A leaf mesh may have T-vertices; the display closes the
// gaps at T-vertices.
IrradianceMesh LeafMesh(const ElementForest& forest, std::span<const Rgb> irradiance);

}  // namespace penumbra::viewer
