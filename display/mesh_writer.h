// display/mesh_writer.h
//
// Writers of irradiance meshes for other programs: one interface for all formats.

#pragma once

#include <string>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/base/registry.h"
#include "solver/scene/scene.h"

namespace penumbra {

class MeshWriter {
 public:
  virtual ~MeshWriter() = default;

  // True if the format stores colours for a screen.
  virtual bool HasColours() const = 0;

  // The contents of the file; the same mesh gives the same bytes. `exposure` [m^2/W] converts radiosity to
  // colours, in formats with colours. Throws InputError if the format cannot represent a value.
  virtual std::string Bytes(const Scene& scene, const IrradianceMesh& mesh, double exposure) const = 0;
};

// The type of MeshWriters(). The name of each writer is the ending of its files.
using MeshWriterRegistry = Registry<const MeshWriter>;

}  // namespace penumbra
