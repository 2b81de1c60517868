// solver/scene/named_scene.h

#pragma once

#include <string>

#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

// The scene that a user names: a file or a built-in scene. If a file and a built-in scene have the same name,
// the file is read. The first of SceneReaders() that recognises the name reads the scene; a file that no
// reader recognises is read as OBJ. Throws InputError.
Scene ReadNamedScene(const std::string& name, const SceneOptions& options);

}  // namespace penumbra
