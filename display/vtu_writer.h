// display/vtu_writer.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// The mesh writer for VTK's XML format for unstructured grids (`vtu`). The VTK cells are quadratic triangles,
// which represent the quadratic interpolants of irradiance exactly. The point data of the VTK file are
// `irradiance` and `radiosity` [W/m^2], with three channels in doubles. The cell data of the VTK file are
// `patch`, the number of the face in the user's numbering.
MeshWriterRegistry::Method VtuWriterMethod();

}  // namespace penumbra
