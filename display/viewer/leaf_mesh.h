// display/viewer/leaf_mesh.h

#pragma once

#include <span>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra::viewer {

// The leaves of a forest as triangles of constant irradiance [W/m^2]. `irradiance` is indexed by ElementId.
// The mesh shows a solution at any step: the function computes nothing, and the forest need not be balanced.
// T-vertices remain; the display closes the gaps.
IrradianceMesh LeafMesh(const ElementForest& forest, std::span<const Rgb> irradiance);

}  // namespace penumbra::viewer
