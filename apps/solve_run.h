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

// The options to store with a solution that was read from a file with the options `stored`. The options for
// reading the scene are those of `stored`.
nlohmann::ordered_json StoredOptions(const nlohmann::ordered_json& stored, const SceneArguments& arguments,
                                     const ResolvedOptions& resolved);

// The bytes of a solution file, which do not depend on the number of threads. REQUIRES: the pipeline is
// solved, has interpolants, and is measured.
std::string SolutionFileOf(const Pipeline& pipeline, const nlohmann::ordered_json& options);

// One sentence that says that the requested error was missed, and why; empty if it was met, or if no
// measurement shows that it was missed.
std::string MissedErrorMessage(const PipelineReport& report);

// Runs the pipeline for a command: prints options, shows progress, handles interrupts, and writes the report.
class SolveRun {
 public:
  // With -v, prints the options used; `command_options` are the options of the command itself. The scene and
  // the arguments must outlive this object. Moves the content of a solution file out of `loaded`.
  SolveRun(const SceneArguments& arguments, LoadedScene& loaded,
           const nlohmann::ordered_json& command_options = nlohmann::ordered_json::object());

  // Solves, over the links of LoadedScene::restart if it is set. Builds a mesh of this kind, if `kind` is
  // set. Measures the error if `measure` is true. A solution from a file is neither solved nor measured
  // again: both happened before it was saved. Throws Interrupted.
  void Run(std::optional<MeshKind> kind, bool measure);

  // Builds a flat mesh of the current leaves without solving, for pictures that show no light. Throws
  // Interrupted.
  void RunUnlit();

  // Prints warnings about the scene and about a missed error. Writes the report file if --report is given,
  // and prints the table on standard error with -v.
  void Tell() const;

  const Pipeline& pipeline() const { return pipeline_; }
  RunReport report() const;
  // The bytes of the solution file. REQUIRES: Run(MeshKind::kInterpolant, true) was called.
  std::string SolutionFile() const;

 private:
  const SceneArguments& arguments_;
  double load_seconds_;
  bool stored_, restarts_;
  Pipeline pipeline_;
  nlohmann::ordered_json options_;
};

// Whether a report is requested, by --report or -v.
inline bool WantsReport(const SceneArguments& arguments) {
  return arguments.verbose || arguments.report.has_value();
}

}  // namespace penumbra
