// apps/scene_warnings.h
//
// Warnings about likely mistakes in a scene that can be solved nevertheless. Every command that reads a scene
// prints them.

#pragma once

#include <string>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// The warnings, one sentence each. Without `lit`, omits warnings about light, for commands that do not use
// light.
std::vector<std::string> SceneWarnings(const Scene& scene, bool lit);

}  // namespace penumbra
