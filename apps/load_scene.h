// apps/load_scene.h
//
// Reads the scene of a command, or the solution with its scene.

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
};

struct LoadedScene {
  std::unique_ptr<const Scene> owner;
  const Scene& scene = *owner;
  double seconds = 0;                                // duration of reading
  std::optional<StoredSolve> stored = std::nullopt;  // from a solution file
  // A solution of the same geometry whose links another solve uses: LoadToSolve().
  std::optional<StoredSolve> restart = std::nullopt;
};

// Sets the number of threads and reads the scene, or the solution with its scene. Prints the warnings of
// scenes to standard error. Throws InputError; throws UsageError if options of reading or solving are given
// together with a solution.
LoadedScene LoadScene(const SceneArguments& arguments);
// LoadScene() without its warnings, and the warnings. For callers that may still reject the scene, and then
// print only the error.
LoadedScene LoadWithoutWarnings(const SceneArguments& arguments);
void TellWarnings(const LoadedScene& loaded);
// Reads a solution file. Throws InputError if the file is not a solution.
LoadedScene LoadSolution(const std::string& path);

}  // namespace penumbra
