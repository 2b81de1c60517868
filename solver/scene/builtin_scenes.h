// solver/scene/builtin_scenes.h
//
// The built-in scenes. The geometry of a built-in scene is an OBJ file in the folder scenes/, or is generated
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

// All built-in scenes, except that only the smallest of the buildings is included.
const std::vector<BuiltinScene>& BuiltinScenes();

// The built-in scene called `name`, with its cameras; nullopt if there is no such scene. Throws InputError if
// the options do not fit the scene.
std::optional<Scene> LoadBuiltinScene(std::string_view name, const SceneOptions& options);

// The reader of built-in scenes. The reader recognises the name of a built-in scene unless a file has the
// same name.
SceneReaderRegistry::Method BuiltinSceneReaderMethod();

}  // namespace penumbra
