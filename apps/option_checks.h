// apps/option_checks.h
//
// Refuses options of a solve that contradict each other or do not fit the scene, before the work begins.

#pragma once

#include "apps/scene_arguments.h"

namespace penumbra {

// Whether only the hierarchical solver uses the option. `name` is the option's name without the leading
// dashes.
bool IsHierarchicalOption(const std::string& name);

// Throws UsageError for options that contradict each other.
void CheckOptions(const SceneArguments& arguments);

// Throws UsageError for distances that are too large for the scene.
void CheckDistances(const SceneArguments& arguments, const Scene& scene);

// A warning, one sentence, if a solve with these options may take extremely long; empty otherwise.
std::string CostNote(const SceneArguments& arguments, const ResolvedOptions& resolved);

}  // namespace penumbra
