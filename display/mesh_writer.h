// display/mesh_writer.h
//
// The interface of writers that export irradiance meshes to other programs. Each mesh file format has its own
// writer.

#pragma once

#include <optional>
#include <string>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/base/registry.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The input of a mesh writer. `scene` and `mesh` must outlive the MeshExport.
struct MeshExport {
  const Scene& scene;
  const IrradianceMesh& mesh;
  Camera camera;  // the camera from which the exported scene is first shown
  // exposure of colours [m^2/W]; nullopt: the mesh writer determines an exposure
  std::optional<double> exposure = {};
};

class MeshWriter {
 public:
  virtual ~MeshWriter() = default;

  // True if files of the writer's format contain colours for a screen.
  virtual bool HasColours() const = 0;

  // True if files of the writer's format contain a camera.
  virtual bool HasCamera() const { return false; }

  // The contents of the mesh file. Equal meshes give files with equal bytes. If the format has colours, the
  // colours are exposure [m^2/W] * radiosity [W/m^2]. Throws InputError if the file format cannot represent a
  // value.
  virtual std::string Bytes(const MeshExport& from) const = 0;
};

// The type of the registry MeshWriters(). The name of a mesh writer in the registry is the ending of its
// files, without the dot.
using MeshWriterRegistry = Registry<const MeshWriter>;

}  // namespace penumbra
