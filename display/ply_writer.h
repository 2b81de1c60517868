// display/ply_writer.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// The mesh writer for binary little-endian PLY. Each triangle of the mesh is written as four PLY triangles.
// PLY vertices have positions as floats, `irradiance_r/g/b` and `radiosity_r/g/b` [W/m^2], and colours for a
// screen. The colours are exposure [m^2/W] * radiosity [W/m^2] in sRGB, with white emitters. Each PLY
// triangle has the property `patch`, the number of the face in the scene file.
MeshWriterRegistry::Method PlyWriterMethod();

}  // namespace penumbra
