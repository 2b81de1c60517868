#include "solver/scene/named_scene.h"

#include <filesystem>
#include <optional>
#include <utility>

#include "solver/base/check.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/obj_reader.h"

namespace penumbra {

Scene ReadNamedScene(const std::string& name, const SceneOptions& options) {
  std::error_code ignored;
  if (std::filesystem::exists(name, ignored) && !std::filesystem::is_directory(name, ignored))
    return ReadObj(name, options);
  if (std::optional<Scene> scene = LoadBuiltinScene(name, options)) return std::move(*scene);
  throw InputError(
      name +
      ":0: error: there is no such file and no built-in scene of that name; `penumbra scenes` lists those");
}

}  // namespace penumbra
