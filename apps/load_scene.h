// apps/load_scene.h
//
// The scene, or the solution with its scene, that a command was given.

#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/scene_arguments.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene.h"

namespace penumbra {

// A solution file's share in a run.
struct StoredSolve {
  PipelineState state;             // what is left of it once a SolveRun took it is unspecified
  PipelineOptions solving;         // how it was solved,
  nlohmann::ordered_json options;  // in the words of OptionsUsed(), without `threads`
  std::string version;             // of the program that solved it
};

struct LoadedScene {
  std::unique_ptr<const Scene> owner;
  const Scene& scene = *owner;
  double seconds = 0;                                // that reading it took
  std::optional<StoredSolve> stored = std::nullopt;  // of a solution file
  // Of a solution of the same geometry, whose links another solve begins with: LoadToSolve().
  std::optional<StoredSolve> restart = std::nullopt;
};

// Sets the number of threads and reads the scene, or the solution with its scene; warnings of scenes go to
// standard error. Throws InputError, and UsageError if options of reading or solving come with a solution.
LoadedScene LoadScene(const SceneArguments& arguments);
// The same without the warnings, and these: for who may yet refuse what was read, which is told alone.
LoadedScene LoadWithoutWarnings(const SceneArguments& arguments);
void TellWarnings(const LoadedScene& loaded);
// Reads a solution file. Throws InputError if it is none.
LoadedScene LoadSolution(const std::string& path);

}  // namespace penumbra
