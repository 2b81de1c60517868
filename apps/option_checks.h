// apps/option_checks.h
//
// Refuses options of a solve that contradict each other or do not fit the scene, before the work begins.

#pragma once

#include "apps/scene_arguments.h"

namespace penumbra {

// Throws UsageError for options that contradict each other.
void CheckOptions(const SceneArguments& arguments);

// Throws UsageError for distances that are too large for the scene.
void CheckDistances(const SceneArguments& arguments, const Scene& scene);

// What a solve with these options may cost beyond measure, in a sentence; empty where nothing is to be said.
std::string CostNote(const SceneArguments& arguments, const ResolvedOptions& resolved);

}  // namespace penumbra
