// apps/restart.h
//
// The option `--restart`: solves a scene with changed emittances or reflectances by using the links of a
// solution of the same geometry.

#pragma once

#include "apps/load_scene.h"
#include "apps/scene_arguments.h"

namespace penumbra {

// Like LoadScene(), but for commands that solve the scene. If the user gives --restart FILE, LoadToSolve()
// also reads the solution FILE into LoadedScene::restart, and sets the link options (IsLinkOption) to the
// values of this solution. Throws InputError if FILE is not a solution, has no links, or has another
// geometry. Throws UsageError if --restart is given and the input of the command is a solution instead of a
// scene, or if link options (IsLinkOption) are given.
LoadedScene LoadToSolve(SceneArguments& arguments);

}  // namespace penumbra
