// apps/dim_option.h
//
// The option `--dim`, which multiplies the light of emitters by factors.

#pragma once

#include <CLI/CLI.hpp>

#include <span>

#include "apps/load_scene.h"
#include "apps/scene_arguments.h"
#include "solver/scene/emitters.h"

namespace penumbra {

// Adds the option `--dim NAME=FACTOR` to the command line; the option may be given several times.
CLI::Option* AddDimOption(CLI::App& app, SceneArguments* arguments);

// Multiplies the emittances of a scene by the factors of `dims`. Throws UsageError if a name in `dims`
// belongs to no emitter.
void DimScene(std::span<const Dimming> dims, Scene& scene);

// Multiplies the emittances in a solution, and the stored light of each emitter, by the factors of --dim,
// without solving again. The measured errors of the solution are dropped if the light changes. Throws
// UsageError if a name belongs to no emitter, or only to a part of a group that the solution stores as one
// emitter. Throws InputError if the solution does not store the light of each emitter. REQUIRES: `loaded` is
// a solution, so that loaded.stored is set.
LoadedScene DimSolution(const SceneArguments& arguments, LoadedScene loaded);

}  // namespace penumbra
