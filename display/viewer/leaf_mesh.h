// display/viewer/leaf_mesh.h

#pragma once

#include <span>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra::viewer {

// The leaves of a forest as triangles of constant irradiance [W/m^2], indexed by ElementId: what there is to
// see of a solution at any step. Nothing is computed and nothing need be balanced; T-vertices remain, which
// the display closes.
IrradianceMesh LeafMesh(const ElementForest& forest, std::span<const Rgb> irradiance);

}  // namespace penumbra::viewer
