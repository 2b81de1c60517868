// apps/scene_warnings.h
//
// Warnings about likely mistakes in a scene that do not prevent solving the scene. Every command that reads a
// scene prints the warnings about the scene.

#pragma once

#include <string>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// Returns the warnings about a scene, one sentence for each. If `lit` is false, warnings about light are
// omitted, as for commands that do not compute light.
std::vector<std::string> SceneWarnings(const Scene& scene, bool lit);

}  // namespace penumbra
