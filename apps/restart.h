// apps/restart.h
//
// The option --restart: computes the light of a scene over the links of a solution of the same geometry, with
// other emittances or reflectances.

#pragma once

#include "apps/scene_arguments.h"

namespace penumbra {

// LoadScene() for commands that solve. With --restart, also reads the solution that the option names, into
// LoadedScene::restart; the solver will use its links. The options that control how links are made take the
// values of the solution file. Throws InputError if the file is not a solution, has no links, or has another
// geometry. Throws UsageError if the scene argument is a solution, or if the arguments contain options of
// links (kLinkOptions), because the links exist already.
LoadedScene LoadToSolve(SceneArguments& arguments);

}  // namespace penumbra
