// display/ply_writer.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// Binary PLY, little-endian: each triangle as four. Vertices carry float positions, `irradiance_r/g/b`,
// `radiosity_r/g/b` [W/m^2], and colours for a screen: the exposed radiosity [m^2/W times W/m^2] in sRGB,
// emitters white. Faces carry `patch`.
MeshWriterRegistry::Method PlyWriterMethod();

}  // namespace penumbra
