// solver/scene/scene_readers.h

#pragma once

#include "solver/scene/scene_reader.h"

namespace penumbra {

// The registry of all scene readers. The first reader of the registry reads the files that no reader
// recognises.
SceneReaderRegistry& SceneReaders();

// True if some scene reader reads files whose names have the same ending as `path`.
bool HasSceneEnding(const std::string& path);

}  // namespace penumbra
