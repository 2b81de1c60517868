// display/mesh_writers.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// The registry of all formats of meshes.
MeshWriterRegistry& MeshWriters();

}  // namespace penumbra
