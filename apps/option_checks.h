// apps/option_checks.h
//
// Rejects options of a solve that contradict each other or do not fit the scene, before the work begins.

#pragma once

#include "apps/scene_arguments.h"

namespace penumbra {

// Throws UsageError if options contradict each other.
void CheckOptions(const SceneArguments& arguments);

// Throws UsageError if distances are too large for the scene.
void CheckDistances(const SceneArguments& arguments, const Scene& scene);

// A sentence of warning if a solve with these options may take extremely long; otherwise empty.
std::string CostNote(const SceneArguments& arguments, const ResolvedOptions& resolved);

}  // namespace penumbra
