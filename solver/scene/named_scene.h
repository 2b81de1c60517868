// solver/scene/named_scene.h

#pragma once

#include <string>

#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

// Reads the scene with the name that a user has given: a file or a built-in scene. If a file and a built-in
// scene have the same name, the file is read. The scene is read by the first reader in the list
// SceneReaders() that recognises the name; a file that no reader recognises is read as OBJ. Throws InputError
// if the scene cannot be read.
Scene ReadNamedScene(const std::string& name, const SceneOptions& options);

}  // namespace penumbra
