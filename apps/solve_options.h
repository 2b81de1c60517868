// apps/solve_options.h
//
// The options of a solve on the command line, which the table of options gives.

#pragma once

#include "apps/scene_arguments.h"

namespace penumbra {

// Adds them all, and to the help of `app` what only studies choose. REQUIRES: AddSceneArguments().
void AddSolveOptions(CLI::App& app, SceneArguments* arguments);

}  // namespace penumbra
