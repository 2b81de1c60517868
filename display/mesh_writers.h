// display/mesh_writers.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// Every format that meshes are written in.
MeshWriterRegistry& MeshWriters();

}  // namespace penumbra
