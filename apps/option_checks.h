// apps/option_checks.h
//
// Checks the options of a solve before the work begins, and rejects options that contradict each other or do
// not fit the scene.

#pragma once

#include "apps/scene_arguments.h"

namespace penumbra {

// Throws UsageError if options contradict each other.
void CheckOptions(const SceneArguments& arguments);

// Throws UsageError if a distance among the options is too large for the size of the scene.
void CheckDistances(const SceneArguments& arguments, const Scene& scene);

// A warning, one sentence, that a solve with these options may take extremely long; empty if there is no
// reason for a warning.
std::string CostNote(const SceneArguments& arguments, const ResolvedOptions& resolved);

}  // namespace penumbra
