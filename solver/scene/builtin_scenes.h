// solver/scene/builtin_scenes.h
//
// The scenes that the program brings along. Their geometry stands as OBJ in the folder scenes/, or is made
// from the numbers in the name (building.h).

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"
#include "solver/scene/scene_reader.h"

namespace penumbra {

struct BuiltinScene {
  std::string name;
  std::string description;  // one line
  std::vector<Camera> cameras;
};

// One of each kind: of the buildings the smallest.
const std::vector<BuiltinScene>& BuiltinScenes();

// The built-in scene with its cameras; nothing if there is none of that name. Throws InputError where the
// options do not suit the scene.
std::optional<Scene> LoadBuiltinScene(std::string_view name, const SceneOptions& options);

// Their names, where no file has the same.
SceneReaderRegistry::Method BuiltinSceneReaderMethod();

}  // namespace penumbra
