#include "apps/solve_run.h"

#include <fmt/format.h>

#include <chrono>
#include <string_view>
#include <utility>

#include "apps/interruptible.h"
#include "apps/messages.h"
#include "apps/option_checks.h"
#include "apps/options_used.h"
#include "apps/output.h"
#include "mesh/pipeline/solution_file.h"
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
  told.dims.clear();
  // An older file lacks options that came later.
  PENUMBRA_DCHECK(loaded.stored->schema < kSolutionSchema ||
                  LastingOptions(StoredOptions(options, told, pipeline.resolved())) == options);
  for (const Dimming& dimming : arguments.dims)
    options["dim"][dimming.name] = {dimming.factor[0], dimming.factor[1], dimming.factor[2]};
  options["solution"] = arguments.scene;
  options["threads"] = ThreadCount();
  return options;
}

}  // namespace

std::string MissedErrorMessage(const PipelineReport& report) {
  constexpr std::string_view kOfError = "error: ";
  std::string error, reasons;
  for (const std::string& line : report.unmet) {
    if (line.starts_with(kOfError))
      error += (error.empty() ? "" : "; ") + line.substr(kOfError.size());
    else
      reasons += (reasons.empty() ? "" : "; ") + line;
  }
  if (report.error_met || (error.empty() && reasons.empty())) return "";
  if (!error.empty()) return reasons.empty() ? error : fmt::format("{}; {}", error, reasons);
  return fmt::format("whether the error asked for, {:g}, was met is not measured (--report does): {}",
                     report.error_asked, reasons);
}

nlohmann::ordered_json StoredOptions(const nlohmann::ordered_json& stored, const SceneArguments& arguments,
                                     const ResolvedOptions& resolved) {
  nlohmann::ordered_json options = stored;
  options.update(OptionsUsed(arguments, &resolved));
  for (const char* reading : {"scene", "emission_is_radiance", "flip", "two_sided"})
    if (stored.contains(reading))
      options[reading] = stored.at(reading);
    else
      options.erase(reading);  // there was no such option then
  return options;
}

std::string SolutionFileOf(const Pipeline& pipeline, const nlohmann::ordered_json& options) {
  const std::string report = LastingReportJson(pipeline.report());
  try {
    PipelineReportFrom(nlohmann::ordered_json::parse(report));
  } catch (const nlohmann::json::exception&) {  // JSON has no word for what is no number
    throw InputError(
        fmt::format("{}: error: the report holds what is no number, and the solution is not fit to be kept: "
                    "this is a mistake of the program, and another --error may get around it",
                    pipeline.scene().name));
  }
  return EncodeSolution(
      pipeline,
      LastingOptions(options).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace), report,
      PENUMBRA_VERSION);
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
  const std::string note = stored_ ? "" : CostNote(arguments, pipeline_.resolved());
  if (!note.empty()) Say(note);
}

void RunStages(const RunPlan& plan, Pipeline* pipeline, const ExecutionContext& context) {
  if (plan.restarts)
    pipeline->SolveOverLinks(context);
  else if (!plan.stored)
    pipeline->Solve(context);
  if (!plan.stored && !context.Cancelled()) pipeline->RefineLight(context);
  // What the light errs by is seen from interpolants, whatever is shown.
  const bool glances =
      !plan.stored && !plan.measure && (pipeline->RefinesLight() || plan.kind == MeshKind::kInterpolant);
  if (glances && !context.Cancelled()) pipeline->BuildMesh(MeshKind::kInterpolant, context);
  if (glances && !context.Cancelled()) pipeline->CheckErrorRoughly(context);
  // Where a limit has ended that, asking for the same once more would change nothing.
  const bool is_made = glances && plan.kind == MeshKind::kInterpolant;
  if (!context.Cancelled() && plan.kind && !is_made) pipeline->BuildMesh(*plan.kind, context);
  if (context.Cancelled() || !plan.kind || !plan.measure) return;
  if (plan.stored)
    pipeline->Diagnose();  // its error was measured when it was solved
  else
    pipeline->Measure(context);
}

void SolveRun::Run(std::optional<MeshKind> kind, bool measure) {
  RunInterruptible([&](const ExecutionContext& context) {
    RunStages({kind, measure, stored_, restarts_}, &pipeline_, context);
  });
}

void SolveRun::RunUnlit() {
  RunInterruptible([&](const ExecutionContext& context) {
    if (!stored_ && !restarts_) pipeline_.Link(context);
    if (!context.Cancelled()) pipeline_.BuildMesh(MeshKind::kFlat, context);
  });
}

std::string SolveRun::SolutionFile() const { return SolutionFileOf(pipeline_, options_); }

void SolveRun::Tell() const {
  for (const std::string& warning : pipeline_.report().warnings) Say(warning);
  const std::string missed = MissedErrorMessage(pipeline_.report());
  if (!missed.empty()) Say(fmt::format("{}: warning: {}", arguments_.scene, missed));
  if (arguments_.report) WriteResult(arguments_.report, ReportJson(report()));
  if (arguments_.verbose) PrintText(ReportTable(report()));
}

RunReport SolveRun::report() const { return {options_, load_seconds_, pipeline_.report()}; }

}  // namespace penumbra
