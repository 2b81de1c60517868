// apps/scene_arguments.h
//
// The arguments of all commands that take a SCENE: the scene, and the options for reading and solving the
// scene.

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
  const CLI::App* app = nullptr;    // knows which options were given; null: none
  std::string scene;                // a path, or the name of a built-in scene
  std::vector<std::string> scenes;  // of commands that take several, which work on one after the other
  SceneOptions reading;
  std::vector<MaterialChange> emittance, reflectance;
  std::vector<Dimming> dims;  // factors on the light of emitters (AddDimOption)
  PipelineOptions solving;
  int threads = 0;  // 0: all processors
  bool verbose = false;
  std::optional<std::string> report;   // path of the report
  std::optional<std::string> restart;  // the solution whose links the solve uses: LoadToSolve()
  OutputFiles outputs;                 // files that the command writes; no input file may be one of them
  bool lit = true;                     // the command computes light, not only geometry
};

// The heading in the help for the options that concern the reading of scenes.
inline constexpr const char* kSceneGroup = "Scene";

// Adds the options for threads, seed and verbosity, which all commands with long computations have.
void AddRunningOptions(CLI::App& app, int* threads, std::uint64_t* seed, bool* verbose);
// Adds the positional argument, SCENE or SOLUTION, and the options for reading, threads, seed and verbosity.
void AddSceneArguments(CLI::App& app, SceneArguments* arguments);
// The same for commands that take several scenes: they stand in SceneArguments::scenes, and `scene` is empty.
void AddSeveralScenesArguments(CLI::App& app, SceneArguments* arguments);
// Throws UsageError if a file, which the option `name` would write, is given beside several scenes.
void RefuseForSeveralScenes(const SceneArguments& arguments, const std::string& name,
                            const std::optional<std::string>& file);
CLI::Option* AddReportOption(CLI::App& app, SceneArguments* arguments);
CLI::Option* AddRestartOption(CLI::App& app, SceneArguments* arguments);

// True if the user has given the option `name`, for example `--eps`.
bool IsGiven(const SceneArguments& arguments, const std::string& name);

}  // namespace penumbra
