// apps/scene_arguments.h
//
// The arguments of all commands that take a scene: the scene's name, and the options for reading and solving
// the scene.

#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/material_change.h"
#include "apps/output.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/scene/emitters.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

struct SceneArguments {
  const CLI::App* app = nullptr;    // command that knows which options were given; null if none was given
  std::string scene;                // path of a file, or name of a built-in scene
  std::vector<std::string> scenes;  // scenes of commands that process several scenes
  SceneOptions reading;
  std::vector<MaterialChange> emittance, reflectance;
  std::vector<Dimming> dims;  // factors by which the light of emitters is multiplied (AddDimOption)
  PipelineOptions solving;
  int threads = 0;  // number of threads; 0 for all processors
  bool verbose = false;
  std::optional<std::string> report;   // path of the report file
  std::optional<std::string> restart;  // path of the solution whose links are used (LoadToSolve)
  // The output files of the command, which must differ from all input files.
  OutputFiles outputs;
  bool lit = true;  // true if the command computes light, not only geometry
};

// The heading, in the help, of the options for reading scenes.
inline constexpr const char* kSceneGroup = "Scene";

// Adds the options for threads, seed and verbosity, which all commands with long computations have, to the
// command line.
void AddRunningOptions(CLI::App& app, int* threads, std::uint64_t* seed, bool* verbose);
// Adds the positional argument, a scene or a solution, and the options for reading scenes, threads, seed and
// verbosity.
void AddSceneArguments(CLI::App& app, SceneArguments* arguments);
// Like AddSceneArguments(), but for commands that take several scenes. The names of the scenes are stored in
// SceneArguments::scenes, and SceneArguments::scene is empty.
void AddSeveralScenesArguments(CLI::App& app, SceneArguments* arguments);
// Throws UsageError if several scenes are given together with the option `name`, which names an output file.
void RefuseForSeveralScenes(const SceneArguments& arguments, const std::string& name,
                            const std::optional<std::string>& file);
CLI::Option* AddReportOption(CLI::App& app, SceneArguments* arguments);
CLI::Option* AddRestartOption(CLI::App& app, SceneArguments* arguments);

// True if the user has given the option called `name`, for example `--eps`.
bool IsGiven(const SceneArguments& arguments, const std::string& name);

}  // namespace penumbra
