// apps/solve_options.h
//
// Adds the options of a solve to the command line. OptionTable() lists all options of a solve.

#pragma once

#include "apps/scene_arguments.h"

namespace penumbra {

// Adds all options of OptionTable() to the command `app`. The help of the command `app` also lists the values
// SolveOption::study_choices. REQUIRES: AddSceneArguments() was called.
void AddSolveOptions(CLI::App& app, SceneArguments* arguments);

}  // namespace penumbra
