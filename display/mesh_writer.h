// display/mesh_writer.h
//
// Irradiance meshes for other programs: a writer for each format behind one interface.

#pragma once

#include <string>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/base/registry.h"
#include "solver/scene/scene.h"

namespace penumbra {

class MeshWriter {
 public:
  virtual ~MeshWriter() = default;

  // Whether the format holds colours for a screen.
  virtual bool HasColours() const = 0;

  // What the file holds; the same mesh gives the same bytes. `exposure` [m^2/W] makes the colours, if there
  // are any. Throws InputError if a value does not fit into the format.
  virtual std::string Bytes(const Scene& scene, const IrradianceMesh& mesh, double exposure) const = 0;
};

// MeshWriters() holds all writers. The name of each is the ending of its files.
using MeshWriterRegistry = Registry<const MeshWriter>;

}  // namespace penumbra
