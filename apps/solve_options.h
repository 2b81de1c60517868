// apps/solve_options.h
//
// The options of a solve on the command line, from the table of options.

#pragma once

#include "apps/scene_arguments.h"

namespace penumbra {

// Adds all options of the table, and the choices for studies to the help of `app`. REQUIRES:
// AddSceneArguments() was called.
void AddSolveOptions(CLI::App& app, SceneArguments* arguments);

}  // namespace penumbra
