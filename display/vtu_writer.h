// display/vtu_writer.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// The writer of VTK's XML format for unstructured grids. The cells are quadratic triangles, which represent
// the interpolants exactly. Point data are `irradiance` and `radiosity` [W/m^2], with three channels in
// doubles. Cell data are `patch`, the number of the face in the user's numbering.
MeshWriterRegistry::Method VtuWriterMethod();

}  // namespace penumbra
