// apps/load_scene.h
//
// Reads the scene, or the solution including its scene, that the user names as the input of a command.

#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/scene_arguments.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The contents of a solution file.
struct StoredSolve {
  PipelineState state;             // unspecified after a SolveRun took it
  PipelineOptions solving;         // the options of the solve
  nlohmann::ordered_json options;  // the same in the format of OptionsUsed(), without `threads`
  std::string version;             // of the program that wrote the file
  int schema = 0;                  // of the file
};

struct LoadedScene {
  std::unique_ptr<const Scene> owner;
  const Scene& scene = *owner;
  double seconds = 0;                                // duration of reading
  std::optional<StoredSolve> stored = std::nullopt;  // from a solution file
  // The solution that the user names with --restart: its geometry is that of `scene`, and its links are used
  // to solve `scene` (LoadToSolve).
  std::optional<StoredSolve> restart = std::nullopt;
};

// Sets the number of threads, and reads the scene, or the solution including its scene. Multiplies the light
// of emitters by the factors of --dim: a scene is read with other emittances, and a solution gets the sum of
// the lights of its emitters. Throws UsageError if --dim names no emitter; throws InputError if a solution
// does not keep the light of each emitter. Prints warnings about the scene to standard error. Throws
// InputError if the file cannot be used. Throws UsageError if options of reading or solving are given
// together with a solution.
LoadedScene LoadScene(const SceneArguments& arguments);
// LoadWithoutWarnings() does the same as LoadScene(), but prints no warnings; TellWarnings() prints them. Use
// LoadWithoutWarnings() and TellWarnings() if the scene may still be rejected, so that only the error is
// printed.
LoadedScene LoadWithoutWarnings(const SceneArguments& arguments);
void TellWarnings(const LoadedScene& loaded);
// Reads a solution file. Throws InputError if the file is not a solution.
LoadedScene LoadSolution(const std::string& path);

}  // namespace penumbra
