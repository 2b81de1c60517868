// apps/solve_run.h

#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/load_scene.h"
#include "apps/report.h"
#include "apps/scene_arguments.h"
#include "mesh/pipeline/pipeline.h"

namespace penumbra {

// What a file keeps of the options of a solution that came from a file with `stored` options: those of
// reading are the scene's there.
nlohmann::ordered_json StoredOptions(const nlohmann::ordered_json& stored, const SceneArguments& arguments,
                                     const ResolvedOptions& resolved);

// The bytes of a solution file, the same for every number of threads. REQUIRES: the pipeline is solved, has
// interpolants, and is measured.
std::string SolutionFileOf(const Pipeline& pipeline, const nlohmann::ordered_json& options);

// Whether the error asked for was missed, and what else fell short, in one sentence; empty if it was met, or
// nothing says that it was not.
std::string WhatWasMissed(const PipelineReport& report);

// A scene on its way through the pipeline, as commands drive it: options are told, progress is shown, an
// interrupt ends it, the report is written.
class SolveRun {
 public:
  // Prints the options used, with -v; `command_options` are those of the command itself. The scene and the
  // arguments must outlive this object. What a solution file brought is taken out of `loaded`.
  SolveRun(const SceneArguments& arguments, LoadedScene& loaded,
           const nlohmann::ordered_json& command_options = nlohmann::ordered_json::object());

  // Solves, over the links of LoadedScene::restart if there are such, and builds the mesh, if one is wanted;
  // measures it, too, where someone asked for a report. A stored solution is solved and measured already.
  // Throws Interrupted.
  void Run(std::optional<MeshKind> kind, bool measure);

  // Builds a flat mesh of the leaves there are, for what needs no light: nothing is solved. Throws
  // Interrupted.
  void RunUnlit();

  // Warns of what looks wrong in the scene and of what missed the target; writes the report to its file, if
  // it was asked for, and the table to standard error, with -v.
  void Tell() const;

  const Pipeline& pipeline() const { return pipeline_; }
  RunReport report() const;
  // The bytes of its solution file. REQUIRES: Run(MeshKind::kInterpolant, true).
  std::string SolutionFile() const;

 private:
  const SceneArguments& arguments_;
  double load_seconds_;
  bool stored_, restarts_;
  Pipeline pipeline_;
  nlohmann::ordered_json options_;
};

// Whether anyone reads a report: --report or -v.
inline bool WantsReport(const SceneArguments& arguments) {
  return arguments.verbose || arguments.report.has_value();
}

}  // namespace penumbra
