// solver/scene/scene_readers.h

#pragma once

#include "solver/scene/scene_reader.h"

namespace penumbra {

// Every reader there is. The first one reads the files that no other recognises.
SceneReaderRegistry& SceneReaders();

// Whether the path has the ending of a file that one of them reads.
bool HasSceneEnding(const std::string& path);

}  // namespace penumbra
