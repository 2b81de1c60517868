// solver/scene/builtin_scenes.h
//
// The built-in scenes of the program. The geometry of a built-in scene is an OBJ file in the folder scenes/,
// or is generated from the numbers in the scene's name (building.h).

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
  std::string description;  // a description of the built-in scene in one line
  std::vector<Camera> cameras;
};

// The list of all built-in scenes; of the generated buildings, only the smallest is listed.
const std::vector<BuiltinScene>& BuiltinScenes();

// The built-in scene called `name`, with its cameras; nullopt if no built-in scene has this name. Throws
// InputError if the options do not fit the scene.
std::optional<Scene> LoadBuiltinScene(std::string_view name, const SceneOptions& options);

// The reader of built-in scenes recognises the name of a built-in scene unless a file has the same name.
SceneReaderRegistry::Method BuiltinSceneReaderMethod();

}  // namespace penumbra
