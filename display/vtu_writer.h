// display/vtu_writer.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// VTK's XML format for unstructured grids, with quadratic triangles, which represent the interpolants
// exactly. Point data are `irradiance` and `radiosity` [W/m^2], three channels in doubles. Cell data are
// `patch`, the face in the user's numbering.
MeshWriterRegistry::Method VtuWriterMethod();

}  // namespace penumbra
