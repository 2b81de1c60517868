// display/glb_writer.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// Binary glTF 2.0: the same triangles as in PLY, unlit, in the exposed radiosity as linear vertex colours,
// emitters white; `_IRRADIANCE` and `_RADIOSITY` [W/m^2] as attributes of the application. Its axes are y up:
// the node turns them.
MeshWriterRegistry::Method GlbWriterMethod();

}  // namespace penumbra
