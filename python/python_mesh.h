// python/python_mesh.h

#pragma once

#include <memory>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The Python class Mesh. The mesh may be a member of a larger object, which the shared pointer keeps alive.
struct PythonMesh {
  std::shared_ptr<const IrradianceMesh> mesh;
  std::shared_ptr<const Scene> scene;
};

}  // namespace penumbra
