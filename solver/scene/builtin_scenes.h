// solver/scene/builtin_scenes.h
//
// The built-in scenes. Their geometry is an OBJ file in the folder scenes/, or is generated from the numbers
// in the name (building.h).

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

// All built-in scenes; of the buildings, only the smallest.
const std::vector<BuiltinScene>& BuiltinScenes();

// The built-in scene called `name`, with its cameras; nullopt if there is none. Throws InputError if the
// options do not fit the scene.
std::optional<Scene> LoadBuiltinScene(std::string_view name, const SceneOptions& options);

// Their names, where no file has the same.
SceneReaderRegistry::Method BuiltinSceneReaderMethod();

}  // namespace penumbra
