// display/mesh_writers.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// The registry of all writers of meshes.
MeshWriterRegistry& MeshWriters();

}  // namespace penumbra
