// solver/scene/scene_writers.h

#pragma once

#include "solver/scene/scene_writer.h"

namespace penumbra {

// The registry of all scene writers.
SceneWriterRegistry& SceneWriters();

}  // namespace penumbra
