// display/ply_writer.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// The writer of binary little-endian PLY. Each triangle of the mesh is divided into four. Vertices have float
// positions; `irradiance_r/g/b` and `radiosity_r/g/b` [W/m^2]; and colours for a screen: exposure [m^2/W] *
// radiosity [W/m^2] in sRGB, with white emitters. Faces have the property `patch`, the number of the scene's
// face.
MeshWriterRegistry::Method PlyWriterMethod();

}  // namespace penumbra
