// apps/scene_warnings.h
//
// What in a scene may well be a mistake, though it can be computed: told by every command that reads it.

#pragma once

#include <string>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// A sentence each. Where light plays no part in what is computed (`lit` is false), nothing is said of it.
std::vector<std::string> SceneWarnings(const Scene& scene, bool lit);

}  // namespace penumbra
