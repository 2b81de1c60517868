// solver/scene/named_scene.h

#pragma once

#include <string>

#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

// The scene called `name`: an OBJ file or a built-in scene. A file has precedence. Throws InputError.
Scene ReadNamedScene(const std::string& name, const SceneOptions& options);

}  // namespace penumbra
