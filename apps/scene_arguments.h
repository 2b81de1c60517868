// apps/scene_arguments.h
//
// What all commands share that take a SCENE: which one, how it is read, how it is solved.

#pragma once

#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "mesh/pipeline.h"
#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

struct SceneArguments {
  std::string scene;  // a path, or the name of a built-in scene
  SceneOptions reading;
  PipelineOptions solving;
  int threads = 0;  // 0: all
  bool verbose = false;
  std::optional<std::string> report;  // where the report goes
};

// SCENE, the options of reading it, threads, seed, verbosity.
void AddSceneArguments(CLI::App& app, SceneArguments* arguments);
// The options of the method. REQUIRES: AddSceneArguments.
void AddSolveOptions(CLI::App& app, SceneArguments* arguments);
CLI::Option* AddReportOption(CLI::App& app, SceneArguments* arguments);

// What a user could set and what it came to, by option name with '_' for '-'. Without `resolved` nothing is
// solved, and only what concerns the scene is listed.
nlohmann::ordered_json OptionsUsed(const SceneArguments& arguments, const ResolvedOptions* resolved);
// The "Options used:" block, to standard error.
void PrintOptionsUsed(const nlohmann::ordered_json& options);

struct LoadedScene {
  Scene scene;
  double seconds = 0;  // that reading it took
};

// Sets the number of threads and reads the scene; its warnings go to standard error. Throws InputError.
LoadedScene LoadScene(const SceneArguments& arguments);

}  // namespace penumbra
