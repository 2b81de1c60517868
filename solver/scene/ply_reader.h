// solver/scene/ply_reader.h
//
// Reads PLY files (Turk 1994): polygons in text or binary form. The library Assimp 5.2 is not used for PLY
// files because it hangs on truncated PLY files and rounds doubles to single precision.

#pragma once

#include <string_view>

#include "solver/scene/scene_options.h"
#include "solver/scene/scene_reader.h"

namespace penumbra {

// Returns the scene in the bytes of the PLY file `path`: one object called "default", whose faces have the
// reflectance 0.5. Colours and other properties in the file are left out with a warning. Throws InputError
// with one line, "FILE: error: what is wrong and how to mend it".
Scene ReadPly(std::string_view bytes, const std::string& path, const SceneOptions& options);

// The reader of files that begin with "ply".
SceneReaderRegistry::Method PlyReaderMethod();

}  // namespace penumbra
