// display/vtu_writer.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// VTK's XML for unstructured grids: quadratic triangles, which hold the interpolants themselves. Point data
// `irradiance` and `radiosity` [W/m^2], three channels in doubles; cell data `patch`, the number of the face
// as users count.
MeshWriterRegistry::Method VtuWriterMethod();

}  // namespace penumbra
