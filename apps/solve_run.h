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

// The options to be stored with a solution that was read from a file and is saved again. `stored` are the
// options in the file, from which the options for reading the scene are taken.
nlohmann::ordered_json StoredOptions(const nlohmann::ordered_json& stored, const SceneArguments& arguments,
                                     const ResolvedOptions& resolved);

// The bytes of a solution file, which do not depend on the number of threads. REQUIRES: the pipeline is
// solved, has a mesh of interpolants, and its errors have been measured.
std::string SolutionFileOf(const Pipeline& pipeline, const nlohmann::ordered_json& options);

// One sentence that says that the requested error is exceeded, and why; empty if no measurement shows that
// the error is exceeded.
std::string MissedErrorMessage(const PipelineReport& report);

// What RunStages() makes.
struct RunPlan {
  std::optional<MeshKind> kind;  // of the mesh; none: no mesh
  bool measure = false;          // the error and the energy balance, too
  bool stored = false;           // the pipeline continues from a solution that is complete
  bool restarts = false;         // the pipeline continues from a solution of other materials
};

// Solves the scene of the pipeline, refines its light, and makes the mesh, in the order that every command
// and the Python module follow. Ends early if cancelled.
void RunStages(const RunPlan& plan, Pipeline* pipeline, const ExecutionContext& context);

// Runs the pipeline for a command: prints options, shows progress, handles interrupts, and writes the report.
class SolveRun {
 public:
  // With -v, prints the options used; `command_options` are the options of the command itself. The scene and
  // the arguments must outlive this object. If `loaded` is a solution, its content is moved out of `loaded`.
  SolveRun(const SceneArguments& arguments, LoadedScene& loaded,
           const nlohmann::ordered_json& command_options = nlohmann::ordered_json::object());

  // Solves the scene; uses the links of LoadedScene::restart if it is set. Builds a mesh of this kind if
  // `kind` is set. Measures the error if `measure` is true. A solution from a file is neither solved nor
  // measured again, because it was solved and measured before it was saved. Throws Interrupted if the user
  // interrupts the work.
  void Run(std::optional<MeshKind> kind, bool measure);

  // Builds a flat mesh of the present leaves without solving, for pictures that show no light. Throws
  // Interrupted if the user interrupts the work.
  void RunUnlit();

  // Prints PipelineReport::warnings, and a warning if the requested error is exceeded. Writes the report file
  // if --report is given, and prints the table on standard error with -v.
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

// True if the user requests a report by --report or -v.
inline bool WantsReport(const SceneArguments& arguments) {
  return arguments.verbose || arguments.report.has_value();
}

}  // namespace penumbra
