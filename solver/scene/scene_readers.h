// solver/scene/scene_readers.h

#pragma once

#include "solver/scene/scene_reader.h"

namespace penumbra {

// The registry of all scene readers. The first reader reads the files that no reader recognises.
SceneReaderRegistry& SceneReaders();

// True if one of the readers reads files with the ending of this path.
bool HasSceneEnding(const std::string& path);

}  // namespace penumbra
