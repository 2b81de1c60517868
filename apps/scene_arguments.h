// apps/scene_arguments.h
//
// The arguments of all commands that take a SCENE: the scene, how it is read, and how it is solved.

#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/material_change.h"
#include "apps/output.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

struct SceneArguments {
  const CLI::App* app = nullptr;  // tells which options were given; null: none
  std::string scene;              // a path, or the name of a built-in scene
  SceneOptions reading;
  std::vector<MaterialChange> emittance, reflectance;
  PipelineOptions solving;
  int threads = 0;  // 0: all
  bool verbose = false;
  std::optional<std::string> report;   // path of the report
  std::optional<std::string> restart;  // path of the solution whose links are used: LoadToSolve()
  OutputFiles outputs;                 // output files, which may not be input files
  bool lit = true;                     // whether the command uses light, not only geometry
};

// Adds the options for threads, seed and verbosity, which every long command has.
void AddRunningOptions(CLI::App& app, int* threads, std::uint64_t* seed, bool* verbose);
// Adds the SCENE argument, the options for reading the scene, and AddRunningOptions().
void AddSceneArguments(CLI::App& app, SceneArguments* arguments);
// Adds the options of the solver. REQUIRES: AddSceneArguments() was called.
void AddSolveOptions(CLI::App& app, SceneArguments* arguments);
CLI::Option* AddReportOption(CLI::App& app, SceneArguments* arguments);
CLI::Option* AddRestartOption(CLI::App& app, SceneArguments* arguments);

// All options with the values that were used, by option name with '_' in place of '-'. If `resolved` is null,
// nothing is solved, and only the options of the scene are listed.
nlohmann::ordered_json OptionsUsed(const SceneArguments& arguments, const ResolvedOptions* resolved);
// Reads what OptionsUsed() wrote: OptionsUsed() of the result gives `options` again. Throws
// nlohmann::json::exception.
PipelineOptions SolvingFrom(const nlohmann::ordered_json& options);
// Prints the block "Options used:" on standard error. The same options give the same result again.
void PrintOptionsUsed(const nlohmann::ordered_json& options);

// The content of a solution file, besides the scene.
struct StoredRun {
  PipelineState state;             // unspecified after a SolveRun has taken it
  PipelineOptions solving;         // the options of the solve,
  nlohmann::ordered_json options;  // the same in the format of OptionsUsed(), without `threads`
  std::string version;             // of the program that wrote the file
};

struct LoadedScene {
  std::unique_ptr<const Scene> owner;
  const Scene& scene = *owner;
  double seconds = 0;                              // time for reading
  std::optional<StoredRun> stored = std::nullopt;  // set for a solution file
  // The solution of --restart, of the same geometry, whose links the solve will use: LoadToSolve().
  std::optional<StoredRun> restart = std::nullopt;
};

// Sets the number of threads and reads the scene, or the solution with its scene. Prints warnings about the
// scene on standard error. Throws InputError, and UsageError if options for reading or solving are given with
// a solution.
LoadedScene LoadScene(const SceneArguments& arguments);
// LoadScene() without the warnings, and the warnings. For callers that may refuse the scene after reading it:
// they then print only the error.
LoadedScene LoadQuietly(const SceneArguments& arguments);
void TellWarnings(const LoadedScene& loaded);
// Reads a solution file. Throws InputError if it is not one.
LoadedScene LoadSolution(const std::string& path);

}  // namespace penumbra
