// python/python_mesh.h

#pragma once

#include <memory>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The class Mesh of Python. The mesh may be part of a larger object, which the pointer keeps alive.
struct PythonMesh {
  std::shared_ptr<const IrradianceMesh> mesh;
  std::shared_ptr<const Scene> scene;
};

}  // namespace penumbra
