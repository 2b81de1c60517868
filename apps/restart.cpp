#include "apps/restart.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands.h"
#include "mesh/pipeline/link_options.h"
#include "mesh/pipeline/option_table.h"
#include "mesh/pipeline/solution_check.h"
#include "solver/base/check.h"
#include "solver/scene/geometry_difference.h"

namespace penumbra {
namespace {

LoadedScene LoadRestart(SceneArguments& arguments, const std::string& from) {
  for (const SolveOption& option : OptionTable())
    if (option.links_depend && IsGiven(arguments, CommandLineName(option)))
      throw UsageError(fmt::format(
          "{} says how links are made, but --restart keeps those of '{}'; leave one of the two out",
          CommandLineName(option), from));
  LoadedScene loaded = LoadWithoutWarnings(arguments);
  PENUMBRA_CHECK(!loaded.stored);  // such options are refused beside a solution
  arguments.outputs.RefuseInput(from);
  LoadedScene solved = LoadSolution(from);
  StoredSolve run = std::move(*solved.stored);
  if (run.solving.SolverName() != "hierarchical")
    throw InputError(
        fmt::format("{}: error: the {} solver made it, which keeps no links; solve the scene anew", from,
                    run.solving.SolverName()));
  if (run.state.report.iterations.empty())
    throw InputError(
        fmt::format("{}: error: its solve ended before it had links; solve the scene anew", from));
  if (const std::optional<std::string> difference = GeometryDifference(solved.scene, loaded.scene))
    throw InputError(
        fmt::format("{}: error: it is no solution of '{}' with other materials: {}; solve the scene anew",
                    from, arguments.scene, *difference));
  // The same elements, of patches with other materials.
  ElementForest& forest = run.state.solution.forest;
  forest = RestoreForest(loaded.scene, forest.elements());
  TakeLinkOptions(run.solving, &arguments.solving);
  loaded.restart = std::move(run);
  TellWarnings(loaded);
  return loaded;
}

}  // namespace

LoadedScene LoadToSolve(SceneArguments& arguments) {
  return arguments.restart ? LoadRestart(arguments, *arguments.restart) : LoadScene(arguments);
}

}  // namespace penumbra
