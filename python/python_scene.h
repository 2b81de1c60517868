// python/python_scene.h

#pragma once

#include <memory>
#include <string>

#include "apps/scene_arguments.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The Python class Scene: a scene, and the options with which it was read. Copies of a PythonScene share the
// scene.
struct PythonScene {
  std::shared_ptr<const Scene> scene;
  SceneArguments arguments;  // name of the scene and options for reading it, as stored in solution files
};

}  // namespace penumbra
