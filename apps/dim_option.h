// apps/dim_option.h
//
// The option `--dim`: factors on the light of emitters.

#pragma once

#include <CLI/CLI.hpp>

#include <span>

#include "apps/load_scene.h"
#include "apps/scene_arguments.h"
#include "solver/scene/emitters.h"

namespace penumbra {

// Adds the option `--dim NAME=FACTOR`, which may be given several times.
CLI::Option* AddDimOption(CLI::App& app, SceneArguments* arguments);

// Multiplies the emittances of a scene. Throws UsageError if a name belongs to no emitter.
void DimScene(std::span<const Dimming> dims, Scene& scene);

// Multiplies the light of the emitters of a solution, and its emittances; nothing is solved. The errors that
// the solve measured are dropped if the light changes. Throws UsageError if a name belongs to no emitter, or
// only to a part of what the solution keeps as one emitter, and InputError if the solution does not keep the
// light of each emitter. REQUIRES: loaded.stored.
LoadedScene DimSolution(const SceneArguments& arguments, LoadedScene loaded);

}  // namespace penumbra
