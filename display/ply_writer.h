// display/ply_writer.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// Binary PLY, little-endian, with each triangle divided into four. Vertices have float positions,
// `irradiance_r/g/b` and `radiosity_r/g/b` [W/m^2], and colours for a screen: exposure [m^2/W] * radiosity
// [W/m^2] in sRGB, with white emitters. Faces have `patch`.
MeshWriterRegistry::Method PlyWriterMethod();

}  // namespace penumbra
