// display/glb_writer.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// The writer of binary glTF 2.0. Each triangle of the mesh is divided into four, as in the PLY format. The
// material is unlit. Vertex colours are linear: exposure * radiosity, with white emitters. The
// application-specific attributes `_IRRADIANCE` and `_RADIOSITY` are in W/m^2. glTF's y axis points up; the
// node rotates the scene accordingly.
MeshWriterRegistry::Method GlbWriterMethod();

}  // namespace penumbra
