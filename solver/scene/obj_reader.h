// solver/scene/obj_reader.h
//
// Reads Wavefront OBJ files with MTL material libraries: polygons with any number of vertices, objects,
// groups and materials. Decimal numbers are converted to the nearest binary64 numbers. Texture
// coordinates are kept (Face::uv). Normals, smoothing groups, lines and points in OBJ files are ignored.

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

// Returns the text of the material library with the name that an `mtllib` line gives; nullopt if there is no
// such library.
using MtlSource = std::function<std::optional<std::string>(std::string_view mtl_name)>;

// Returns the scene in the OBJ file, including its patches. Material libraries are searched in the folder of
// the OBJ file. The list Scene::warnings has one line for each kind of repaired faces, dropped faces and
// clamped values. A scene without faces is valid. Throws InputError with one line, "FILE:LINE: error: what is
// wrong and how to mend it" (without LINE for a file that cannot be read).
Scene ReadObj(const std::filesystem::path& path, const SceneOptions& options);

// Reads a scene from a text in the OBJ format, as ReadObj() does from a file. `file_name` is the name of the
// text in messages; `file_name` without its ending becomes the scene's name.
Scene ReadObjText(std::string_view text, std::string_view file_name, const MtlSource& mtl_source,
                  const SceneOptions& options);

// The reader of files whose names end in .obj.
SceneReaderRegistry::Method ObjReaderMethod();

}  // namespace penumbra
