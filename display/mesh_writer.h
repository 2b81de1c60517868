// display/mesh_writer.h
//
// The interface of writers that export irradiance meshes to other programs. Each file format has its own
// writer.

#pragma once

#include <optional>
#include <string>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/base/registry.h"
#include "solver/scene/scene.h"

namespace penumbra {

// What a writer writes. Scene and mesh must outlive it.
struct MeshExport {
  const Scene& scene;
  const IrradianceMesh& mesh;
  Camera camera;                        // from where the scene is first shown
  std::optional<double> exposure = {};  // of colours [m^2/W]; nullopt: the writer finds one
};

class MeshWriter {
 public:
  virtual ~MeshWriter() = default;

  // True if files of this format contain colours for a screen.
  virtual bool HasColours() const = 0;

  // Whether files of this format contain a camera.
  virtual bool HasCamera() const { return false; }

  // The contents of the file. Equal meshes give equal bytes. If the format has colours, they are exposure
  // [m^2/W] * radiosity [W/m^2]. Throws InputError if the format cannot represent a value.
  virtual std::string Bytes(const MeshExport& from) const = 0;
};

// The type of MeshWriters(). The name of a writer is the ending of its files, without the dot.
using MeshWriterRegistry = Registry<const MeshWriter>;

}  // namespace penumbra
