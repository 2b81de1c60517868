// solver/scene/ply_reader.h
//
// PLY files (Turk 1994): polygons in text or binary form. Read here because Assimp 5.2 never ends on
// truncated PLY files, and rounds their doubles.

#pragma once

#include <string_view>

#include "solver/scene/scene_options.h"
#include "solver/scene/scene_reader.h"

namespace penumbra {

// The scene in the bytes of the file `path`: one object, "default", of 50 % grey faces. Colours and other
// properties are left out with a warning. Throws InputError with one line, "FILE: error: what is wrong and
// how to mend it".
Scene ReadPly(std::string_view bytes, const std::string& path, const SceneOptions& options);

// The reader of files that begin with "ply".
SceneReaderRegistry::Method PlyReaderMethod();

}  // namespace penumbra
