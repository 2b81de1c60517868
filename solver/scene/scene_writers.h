// solver/scene/scene_writers.h

#pragma once

#include "solver/scene/scene_writer.h"

namespace penumbra {

// Every format that scenes are written in.
SceneWriterRegistry& SceneWriters();

}  // namespace penumbra
