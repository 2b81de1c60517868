// penumbra solve: the light in a scene, and what it took.

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "apps/commands.h"
#include "apps/output.h"
#include "apps/restart.h"
#include "apps/scene_arguments.h"
#include "apps/solve_options.h"
#include "apps/solve_run.h"

namespace penumbra {
namespace {

// Of the memory that a solve may take: a file is made whole in memory, compressed, beside what it is made of.
constexpr double kKeptForFile = 0.5;

void Solve(SceneArguments arguments, const std::optional<std::string>& output) {
  arguments.outputs.Add("-o", output);
  arguments.outputs.Add("--report", arguments.report);
  LoadedScene loaded = LoadToSolve(arguments);
  if (loaded.stored)
    throw UsageError(
        fmt::format("'{}' is a solution already; give the scene to solve it anew", arguments.scene));
  if (output) arguments.solving.memory_kept = kKeptForFile;
  SolveRun run(arguments, loaded);
  run.Run(MeshKind::kInterpolant, true);
  if (output) WriteResult(output, run.SolutionFile());
  run.Tell();
  if (!output && !WantsReport(arguments)) WriteResult(std::nullopt, ReportTable(run.report()));
}

}  // namespace

Command AddSolveCommand(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("solve", "Solve for the light in a scene, keep it, and report on it");
  const auto arguments = std::make_shared<SceneArguments>();
  const auto output = std::make_shared<std::optional<std::string>>();
  AddSceneArguments(*app, arguments.get());
  app->get_option("SCENE")->description("An OBJ file, or the name of a built-in scene (a file wins)");
  app->add_option(
         "-o,--output", *output,
         "Keep the solution here, as HDF5: the commands that take a SCENE take it instead, and need not "
         "solve again")
      ->type_name("SOLUTION");
  AddSolveOptions(*app, arguments.get());
  AddRestartOption(*app, arguments.get());
  AddReportOption(*app, arguments.get());
  app->footer("Without -o, --report or -v the report goes to standard output, as a table.");
  return {app, [arguments, output] { Solve(*arguments, *output); }};
}

}  // namespace penumbra
