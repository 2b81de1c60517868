// solver/scene/embedded_scenes.h

#pragma once

#include "solver/base/embedded_file.h"

namespace penumbra {

// The files of the folder scenes/, which are compiled into the program, sorted by name. The build generates
// the definition of EmbeddedSceneFiles().
std::span<const EmbeddedFile> EmbeddedSceneFiles();

}  // namespace penumbra
