// display/glb_writer.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// The mesh writer for binary glTF 2.0 (`glb`). Each triangle of the mesh is written as four triangles, as in
// the PLY format. The glTF material of the mesh is unlit. Vertex colours are linear: exposure * radiosity,
// with white emitters. The application-specific vertex attributes `_IRRADIANCE` and `_RADIOSITY` are in
// W/m^2. In glTF, the y axis points up; a rotation in the glTF node turns the scene's z axis upwards.
MeshWriterRegistry::Method GlbWriterMethod();

}  // namespace penumbra
