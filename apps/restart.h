// apps/restart.h
//
// `--restart`: the light of a scene with changed emittances or reflectances, over the links of a solution of
// the same geometry.

#pragma once

#include "apps/load_scene.h"
#include "apps/scene_arguments.h"

namespace penumbra {

// LoadScene() for commands that solve. With --restart, the function also reads that solution into
// LoadedScene::restart, and its links become the links of the scene. The options that determine the links
// (SolveOption::links_depend) get the solution's values. Throws InputError if the file of --restart is no
// solution, has no links, or has another geometry. Throws UsageError if, with --restart, the arguments name a
// solution instead of a scene, or set options that determine the links.
LoadedScene LoadToSolve(SceneArguments& arguments);

}  // namespace penumbra
