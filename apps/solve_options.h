// apps/solve_options.h
//
// Adds the options of a solve to the command line. OptionTable() lists these options.

#pragma once

#include "apps/scene_arguments.h"

namespace penumbra {

// Adds all options of OptionTable() to `app`. The help of `app` also lists the values
// SolveOption::study_choices. REQUIRES: AddSceneArguments() was called.
void AddSolveOptions(CLI::App& app, SceneArguments* arguments);

}  // namespace penumbra
