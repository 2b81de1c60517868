#include "apps/solve_run.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "apps/interruptible.h"
#include "apps/output.h"
#include "mesh/solution_file.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra {

namespace {

Pipeline StartPipeline(const SceneArguments& arguments, LoadedScene& loaded) {
  if (loaded.stored) return Pipeline(loaded.scene, loaded.stored->solving, std::move(loaded.stored->state));
  // Reading took its part of the time.
  PipelineOptions solving = arguments.solving;
  solving.limits_from =
      std::chrono::steady_clock::now() - std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                             std::chrono::duration<double>(loaded.seconds));
  if (loaded.restart) return Pipeline(loaded.scene, solving, std::move(loaded.restart->state));
  return Pipeline(loaded.scene, solving);
}

// What a file keeps of the options: the same for every number of threads.
nlohmann::ordered_json LastingOptions(nlohmann::ordered_json options) {
  options.erase("threads");
  return options;
}

nlohmann::ordered_json StartOptions(const SceneArguments& arguments, const LoadedScene& loaded,
                                    const Pipeline& pipeline) {
  if (!loaded.stored) return OptionsUsed(arguments, &pipeline.resolved());
  nlohmann::ordered_json options = loaded.stored->options;
  // Whatever a solve may be told has to come back out of a file.
  SceneArguments told = arguments;
  told.solving = loaded.stored->solving;
  PENUMBRA_DCHECK(LastingOptions(StoredOptions(options, told, pipeline.resolved())) == options);
  options["solution"] = arguments.scene;
  options["threads"] = ThreadCount();
  return options;
}

}  // namespace

nlohmann::ordered_json StoredOptions(const nlohmann::ordered_json& stored, const SceneArguments& arguments,
                                     const ResolvedOptions& resolved) {
  nlohmann::ordered_json options = stored;
  options.update(OptionsUsed(arguments, &resolved));
  for (const char* reading : {"scene", "emission_is_radiance", "two_sided"})
    options[reading] = stored.at(reading);
  return options;
}

std::string SolutionFileOf(const Pipeline& pipeline, const nlohmann::ordered_json& options) {
  return EncodeSolution(
      pipeline,
      LastingOptions(options).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace),
      LastingReportJson(pipeline.report()), PENUMBRA_VERSION);
}

SolveRun::SolveRun(const SceneArguments& arguments, LoadedScene& loaded,
                   const nlohmann::ordered_json& command_options)
    : arguments_(arguments),
      load_seconds_(loaded.seconds),
      stored_(loaded.stored.has_value()),
      restarts_(loaded.restart.has_value()),
      pipeline_(StartPipeline(arguments, loaded)),
      options_(StartOptions(arguments, loaded, pipeline_)) {
  options_.update(command_options);
  if (arguments_.verbose) PrintOptionsUsed(options_);
}

void SolveRun::Run(std::optional<MeshKind> kind, bool measure) {
  RunInterruptible([&](const ExecutionContext& context) {
    if (restarts_)
      pipeline_.SolveOverLinks(context);
    else if (!stored_)
      pipeline_.Solve(context);
    // What interpolants show refines the sources, which are the same whatever is made of them.
    const bool refines = !stored_ && RefinesLight(arguments_.solving);
    if (refines && !context.Cancelled()) pipeline_.BuildMesh(MeshKind::kInterpolant, context);
    // Where a limit has ended that, asking for the same once more would change nothing.
    const bool is_made = refines && kind == MeshKind::kInterpolant;
    if (!context.Cancelled() && kind && !is_made) pipeline_.BuildMesh(*kind, context);
    if (context.Cancelled() || !kind || !measure) return;
    if (stored_)
      pipeline_.Diagnose();  // its error was measured when it was solved
    else
      pipeline_.Measure(context);
  });
}

void SolveRun::RunUnlit() {
  RunInterruptible([&](const ExecutionContext& context) {
    if (!stored_ && !restarts_) pipeline_.Link(context);
    if (!context.Cancelled()) pipeline_.BuildMesh(MeshKind::kFlat, context);
  });
}

std::string SolveRun::SolutionFile() const { return SolutionFileOf(pipeline_, options_); }

void SolveRun::Tell(bool table_follows) const {
  for (const std::string& warning : pipeline_.report().warnings) fmt::print(stderr, "{}\n", warning);
  if (!stored_ && !table_follows && !WantsReport(arguments_))
    for (const std::string& line : pipeline_.report().unmet)
      fmt::print(stderr, "{}: warning: {}\n", arguments_.scene, line);
  if (arguments_.report) WriteResult(arguments_.report, ReportJson(report()));
  if (arguments_.verbose) fmt::print(stderr, "{}", ReportTable(report()));
}

RunReport SolveRun::report() const { return {options_, load_seconds_, pipeline_.report()}; }

}  // namespace penumbra
