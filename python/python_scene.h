// python/python_scene.h

#pragma once

#include <memory>
#include <string>

#include "apps/scene_arguments.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The class Scene of Python: a scene, and how it was read. Copies share the scene.
struct PythonScene {
  std::shared_ptr<const Scene> scene;
  SceneArguments arguments;  // its name and how it was read, as a command keeps it in a solution file
};

}  // namespace penumbra
