// apps/load_scene.h
//
// Reads the input of a command: a scene, or a solution file, which includes its scene.

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
  PipelineState state;             // results of the solve; unspecified after a SolveRun has taken them over
  PipelineOptions solving;         // the options with which the stored scene was solved
  nlohmann::ordered_json options;  // all options in the format of OptionsUsed(), without `threads`
  std::string version;             // version of the program that wrote the solution file
  int schema = 0;                  // schema number of the solution file
};

struct LoadedScene {
  std::unique_ptr<const Scene> owner;
  const Scene& scene = *owner;
  double seconds = 0;  // the time that reading the scene took [s]
  // The contents of the solution file; nullopt if the scene does not come from a solution file.
  std::optional<StoredSolve> stored = std::nullopt;
  // The solution that the user names with --restart. The solution given with --restart has the same geometry
  // as `scene`, and `scene` is solved with the links of this solution (LoadToSolve).
  std::optional<StoredSolve> restart = std::nullopt;
};

// Sets the number of threads, and reads the scene, or the solution including its scene. The light of emitters
// is multiplied by the factors of --dim: in a scene, the emittances change; in a solution, the stored lights
// of all emitters are scaled and added. Throws UsageError if --dim names no emitter; throws InputError if a
// solution does not store the light of each emitter. Prints warnings about the scene to standard error.
// Throws InputError if the scene or solution file cannot be used. Throws UsageError if the user gives options
// for reading or solving a scene together with a solution.
LoadedScene LoadScene(const SceneArguments& arguments);
// LoadWithoutWarnings() does the same as LoadScene(), but prints no warnings; TellWarnings() prints these
// warnings. Use LoadWithoutWarnings() and TellWarnings() for a scene that may be rejected after loading, so
// that only the error is printed if the scene is rejected.
LoadedScene LoadWithoutWarnings(const SceneArguments& arguments);
void TellWarnings(const LoadedScene& loaded);
// Reads a solution file. Throws InputError if the file is not a solution.
LoadedScene LoadSolution(const std::string& path);

}  // namespace penumbra
