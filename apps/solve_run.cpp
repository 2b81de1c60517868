#include "apps/solve_run.h"

#include <fmt/format.h>

#include "apps/interruptible.h"
#include "apps/output.h"

namespace penumbra {

SolveRun::SolveRun(const SceneArguments& arguments, const LoadedScene& loaded,
                   const nlohmann::ordered_json& command_options)
    : arguments_(arguments),
      load_seconds_(loaded.seconds),
      pipeline_(loaded.scene, arguments.solving),
      options_(OptionsUsed(arguments, &pipeline_.resolved())) {
  options_.update(command_options);
  if (arguments_.verbose) PrintOptionsUsed(options_);
}

void SolveRun::Run(std::optional<MeshKind> kind, bool measure) {
  RunInterruptible([&](const ExecutionContext& context) {
    pipeline_.Solve(context);
    if (!context.Cancelled() && kind) pipeline_.BuildMesh(*kind, context);
    if (!context.Cancelled() && kind && measure) pipeline_.Measure(context);
  });
}

void SolveRun::Tell() const {
  if (arguments_.report) WriteResult(arguments_.report, ReportJson(report()));
  if (arguments_.verbose) fmt::print(stderr, "{}", ReportTable(report()));
}

RunReport SolveRun::report() const { return {options_, load_seconds_, pipeline_.report()}; }

}  // namespace penumbra
