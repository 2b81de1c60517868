// apps/restart.h
//
// The light of a scene over the links of a solution of the same geometry, after emittances or reflectances
// have changed: `--restart`.

#pragma once

#include "apps/load_scene.h"
#include "apps/scene_arguments.h"

namespace penumbra {

// LoadScene(), for who is going to solve. With --restart it reads that solution, too, whose links become
// those of the scene: LoadedScene::restart. The options that say how links are made become those of the file.
// Throws InputError if the file is no solution, has no links, or is of another geometry, and UsageError if
// the arguments name a solution for a scene or say how to make links (SolveOption::links_depend), for that is
// done.
LoadedScene LoadToSolve(SceneArguments& arguments);

}  // namespace penumbra
