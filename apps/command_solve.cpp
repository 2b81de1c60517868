// penumbra solve: the light in a scene, and what it took.

#include <memory>

#include "apps/commands.h"
#include "apps/output.h"
#include "apps/scene_arguments.h"
#include "apps/solve_run.h"

namespace penumbra {
namespace {

void Solve(const SceneArguments& arguments) {
  if (arguments.report) CheckWritable(*arguments.report);
  const LoadedScene loaded = LoadScene(arguments);
  SolveRun run(arguments, loaded);
  run.Run(MeshKind::kInterpolant, true);
  run.Tell();
  if (!WantsReport(arguments)) WriteResult(std::nullopt, ReportTable(run.report()));
}

}  // namespace

Command AddSolveCommand(CLI::App& program) {
  CLI::App* app = program.add_subcommand("solve", "Solve for the light in a scene and report on it");
  const auto arguments = std::make_shared<SceneArguments>();
  AddSceneArguments(*app, arguments.get());
  AddSolveOptions(*app, arguments.get());
  AddReportOption(*app, arguments.get());
  app->footer("Without --report or -v the report goes to standard output, as a table.");
  return {app, [arguments] { Solve(*arguments); }};
}

}  // namespace penumbra
