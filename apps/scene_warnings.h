// apps/scene_warnings.h
//
// Warnings about likely mistakes in a scene that can be solved in spite of the mistakes. Every command that
// reads a scene prints these warnings.

#pragma once

#include <string>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// The warnings, one sentence each. If `lit` is false, warnings about light are omitted; for commands that do
// not compute light.
std::vector<std::string> SceneWarnings(const Scene& scene, bool lit);

}  // namespace penumbra
