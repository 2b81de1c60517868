// apps/restart.h
//
// The light of a scene over the links of a solution of the same geometry, after emittances or reflectances
// have changed: `--restart`.

#pragma once

#include <array>

#include "apps/scene_arguments.h"

namespace penumbra {

// Options of how links are made, which --restart refuses: that is done.
inline constexpr auto kLinkOptions =
    std::to_array<const char*>({"--eps", "--iterations", "--oracle", "--multigrid", "--form-factors",
                                "--solver", "--basis", "--divisions"});

// LoadScene(), for who is going to solve. With --restart it reads that solution, too, whose links become
// those of the scene: LoadedScene::restart. The options that say how links are made become those of the file.
// Throws InputError if the file is no solution, has no links, or is of another geometry, and UsageError if
// the arguments name a solution for a scene or say how to make links.
LoadedScene LoadToSolve(SceneArguments& arguments);

}  // namespace penumbra
