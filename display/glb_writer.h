// display/glb_writer.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// Binary glTF 2.0. The triangles are those of the PLY format, without lighting. Vertex colours are the
// exposed radiosity, linear, with white emitters. The application-specific attributes `_IRRADIANCE` and
// `_RADIOSITY` are in W/m^2. glTF's y axis points up; the node rotates the scene accordingly.
MeshWriterRegistry::Method GlbWriterMethod();

}  // namespace penumbra
