// solver/scene/obj_reader.h
//
// Wavefront OBJ with MTL: polygons with any number of vertices, objects, groups and materials. Numbers are
// read correctly rounded. Texture coordinates, normals, smoothing, lines and points are passed over.

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"
#include "solver/scene/scene_reader.h"

namespace penumbra {

// The text of the material library that an `mtllib` names; nothing if there is none of that name.
using MtlSource = std::function<std::optional<std::string>(std::string_view mtl_name)>;

// The scene in the file, its patches built; material libraries are looked for beside it. What was repaired,
// dropped or clamped stands in Scene::warnings, a line a kind. A scene without faces is valid. Throws
// InputError with the line "FILE:LINE: error: what is wrong and how to mend it" (line 0 for a file that
// cannot be read).
Scene ReadObj(const std::filesystem::path& path, const SceneOptions& options);

// The same from a text; `file_name` stands for it in messages, its stem is the scene's name.
Scene ReadObjText(std::string_view text, std::string_view file_name, const MtlSource& mtl_source,
                  const SceneOptions& options);

// Files that end in .obj.
SceneReaderRegistry::Method ObjReaderMethod();

}  // namespace penumbra
