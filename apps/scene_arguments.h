// apps/scene_arguments.h
//
// What all commands share that take a SCENE: which one, how it is read, how it is solved.

#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/material_change.h"
#include "apps/output.h"
#include "mesh/pipeline/pipeline.h"
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

// Where help lists the options of reading.
inline constexpr const char* kSceneGroup = "Scene";

// Threads, seed and verbosity: of every command that takes long.
void AddRunningOptions(CLI::App& app, int* threads, std::uint64_t* seed, bool* verbose);
// SCENE or SOLUTION, the options of reading it, threads, seed, verbosity.
void AddSceneArguments(CLI::App& app, SceneArguments* arguments);
CLI::Option* AddReportOption(CLI::App& app, SceneArguments* arguments);
CLI::Option* AddRestartOption(CLI::App& app, SceneArguments* arguments);

// Whether the user gave the option, as in `--eps`.
bool IsGiven(const SceneArguments& arguments, const std::string& name);

}  // namespace penumbra
