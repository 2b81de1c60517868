// apps/scene_arguments.h
//
// What all commands share that take a SCENE: which one, how it is read, how it is solved.

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
  const CLI::App* app = nullptr;  // which options were given; null: nobody gave any
  std::string scene;              // a path, or the name of a built-in scene
  SceneOptions reading;
  std::vector<MaterialChange> emittance, reflectance;
  PipelineOptions solving;
  int threads = 0;  // 0: all
  bool verbose = false;
  std::optional<std::string> report;   // where the report goes
  std::optional<std::string> restart;  // the solution whose links a solve begins with: LoadToSolve()
  OutputFiles outputs;                 // what the command will write, which nothing that it reads may be
  bool lit = true;                     // whether it is about light, and not geometry alone
};

// Threads, seed and verbosity: of every command that takes long.
void AddRunningOptions(CLI::App& app, int* threads, std::uint64_t* seed, bool* verbose);
// SCENE or SOLUTION, the options of reading it, threads, seed, verbosity.
void AddSceneArguments(CLI::App& app, SceneArguments* arguments);
// The options of the method. REQUIRES: AddSceneArguments.
void AddSolveOptions(CLI::App& app, SceneArguments* arguments);
CLI::Option* AddReportOption(CLI::App& app, SceneArguments* arguments);
CLI::Option* AddRestartOption(CLI::App& app, SceneArguments* arguments);

// What a user could set and what it came to, by option name with '_' for '-'. Without `resolved` nothing is
// solved, and only what concerns the scene is listed.
nlohmann::ordered_json OptionsUsed(const SceneArguments& arguments, const ResolvedOptions* resolved);
// The same read back: OptionsUsed() of these, resolved, gives `options` again. Throws
// nlohmann::json::exception.
PipelineOptions SolvingFrom(const nlohmann::ordered_json& options);
// The "Options used:" block, to standard error: what, given again, does the same.
void PrintOptionsUsed(const nlohmann::ordered_json& options);

// A solution file's share in a run.
struct StoredRun {
  PipelineState state;             // what is left of it once a SolveRun took it is unspecified
  PipelineOptions solving;         // how it was solved,
  nlohmann::ordered_json options;  // in the words of OptionsUsed(), without `threads`
  std::string version;             // of the program that solved it
};

struct LoadedScene {
  std::unique_ptr<const Scene> owner;
  const Scene& scene = *owner;
  double seconds = 0;                              // that reading it took
  std::optional<StoredRun> stored = std::nullopt;  // of a solution file
  // Of a solution of the same geometry, whose links another solve begins with: LoadToSolve().
  std::optional<StoredRun> restart = std::nullopt;
};

// Sets the number of threads and reads the scene, or the solution with its scene; warnings of scenes go to
// standard error. Throws InputError, and UsageError if options of reading or solving come with a solution.
LoadedScene LoadScene(const SceneArguments& arguments);
// The same without the warnings, and these: for who may yet refuse what was read, which is told alone.
LoadedScene LoadQuietly(const SceneArguments& arguments);
void TellWarnings(const LoadedScene& loaded);
// Reads a solution file. Throws InputError if it is none.
LoadedScene LoadSolution(const std::string& path);

}  // namespace penumbra
