// apps/solve_run.h

#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/load_scene.h"
#include "apps/report.h"
#include "apps/scene_arguments.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/progress.h"

namespace penumbra {

// The options to be stored with a solution that was read from a file and is saved again. The options for
// reading the scene are taken from `stored`, the options in the file.
nlohmann::ordered_json StoredOptions(const nlohmann::ordered_json& stored, const SceneArguments& arguments,
                                     const ResolvedOptions& resolved);

// Returns the bytes of a solution file, which do not depend on the number of threads. REQUIRES: the pipeline
// is solved, has a mesh of interpolants, and its errors have been measured.
std::string SolutionFileOf(const Pipeline& pipeline, const nlohmann::ordered_json& options);

// A message of one sentence that the error of the solution exceeds the requested error, and why; the message
// is empty if no measurement shows that the requested error is exceeded.
std::string MissedErrorMessage(const PipelineReport& report);

// The plan of a run: what RunStages() computes.
struct RunPlan {
  std::optional<MeshKind> kind;  // kind of the mesh; nullopt for no mesh
  bool measure = false;          // if true, the error and the energy balance are measured
  bool stored = false;           // true if the pipeline holds a complete solution from a file
  bool restarts = false;         // true if links of a solution with other materials are used
};

// Solves the scene of the pipeline, refines the light, and makes the mesh, in the same order for all commands
// and the Python module. RunStages() ends early if the context is cancelled.
void RunStages(const RunPlan& plan, Pipeline* pipeline, const ExecutionContext& context);

// Runs the pipeline of a solve for a command: prints options, shows progress, handles interrupts, and writes
// the report.
class SolveRun {
 public:
  // If -v is given, prints the options used; `command_options` are the options of the command itself. The
  // scene and the arguments must outlive the SolveRun. If `loaded` is a solution, the SolveRun moves the
  // solution out of `loaded`.
  SolveRun(const SceneArguments& arguments, LoadedScene& loaded,
           const nlohmann::ordered_json& command_options = nlohmann::ordered_json::object());

  // Solves the scene, with the links of LoadedScene::restart if this member is set. Builds a mesh of the kind
  // `kind`, unless `kind` is nullopt. Measures the error if `measure` is true. A solution from a file was
  // solved and measured before it was saved, and is therefore neither solved nor measured again. Throws
  // Interrupted if the user interrupts the work.
  void Run(std::optional<MeshKind> kind, bool measure);

  // Builds a flat mesh of the undivided elements without solving, for pictures that show no light. Throws
  // Interrupted if the user interrupts the work.
  void RunUnlit();

  // Prints PipelineReport::warnings, and a warning if the error of the solution exceeds the requested error.
  // Writes the report file if --report is given. Prints the report as a table on standard error if -v is
  // given.
  void Tell() const;

  const Pipeline& pipeline() const { return pipeline_; }
  RunReport report() const;
  // Returns the bytes of a file with the solution of this run. REQUIRES: Run(MeshKind::kInterpolant, true)
  // was called.
  std::string SolutionFile() const;

 private:
  const SceneArguments& arguments_;
  double load_seconds_;
  bool stored_, restarts_;
  Pipeline pipeline_;
  nlohmann::ordered_json options_;
};

// True if the user requests a report by --report or -v.
inline bool WantsReport(const SceneArguments& arguments) {
  return arguments.verbose || arguments.report.has_value();
}

}  // namespace penumbra
