// apps/option_checks.h
//
// Checks the options of a solve before the computation begins, and rejects options that contradict each other
// or do not fit the scene.

#pragma once

#include "apps/scene_arguments.h"

namespace penumbra {

// Throws UsageError if options of the command line contradict each other.
void CheckOptions(const SceneArguments& arguments);

// Throws UsageError if an option whose value is a distance is too large for the size of the scene.
void CheckDistances(const SceneArguments& arguments, const Scene& scene);

// A warning of one sentence that a solve with the given options may take extremely long; empty if there is no
// reason for a warning.
std::string CostNote(const SceneArguments& arguments, const ResolvedOptions& resolved);

}  // namespace penumbra
