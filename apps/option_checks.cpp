#include "apps/option_checks.h"

#include <fmt/format.h>

#include <string>
#include <variant>

#include "apps/commands.h"
#include "mesh/pipeline/option_table.h"
#include "solver/base/processes.h"
#include "solver/visibility/exact/occlusion_methods.h"

namespace penumbra {
namespace {

// The distances of the thesis's tricks are meant to be too small to be seen: a thousandth of the scene is a
// hundred times what it used.
constexpr double kMostOfDiagonal = 1e-3;

void CheckOcclusion(const PipelineOptions& solving) {
  if (solving.by_emitter && solving.method != kFastestOcclusion)
    throw UsageError(fmt::format(
        "--by-emitter needs rows of form factors, which --method {} does not give; leave one of them out",
        solving.method));
  if (solving.point.min_backprojection_segment > 0 && solving.method != kFastestOcclusion &&
      solving.method != "backprojection")
    throw UsageError(
        fmt::format("--min-backprojection-segment is of backprojection, and --method {} is another; leave "
                    "one of them out",
                    solving.method));
}

}  // namespace

void CheckOptions(const SceneArguments& arguments) {
  // Commands that solve nothing may have options of the same names.
  if (!arguments.app || !arguments.app->get_option_no_throw("--solver")) return;
  const PipelineOptions& solving = arguments.solving;
  for (const SolveOption& option : OptionTable())
    if (!IsObeyed(option, solving) && IsGiven(arguments, CommandLineName(option)))
      throw UsageError(fmt::format("{} is of {} and means nothing to --solver {}; leave one of them out",
                                   CommandLineName(option), OwnersOf(option), solving.SolverName()));
  for (const char* other : {"--source-error", "--min-backprojection-segment"})
    if (solving.by_emitter && IsGiven(arguments, other))
      throw UsageError(fmt::format(
          "--by-emitter needs the same sources and exact form factors for all emitters, and {} gives others; "
          "leave one of them out",
          other));
  CheckOcclusion(solving);
  if (ProcessCount() > 1 && (solving.time_limit || solving.memory_limit))
    throw UsageError(
        "a limit of time or memory would end each of several processes at another moment; leave it out, or "
        "start one process");
  if (IsGiven(arguments, "--source-error") && solving.max_corrections == 0)
    throw UsageError(
        "--source-error cuts sources for corrections, and --corrections 0 makes none; leave one out");
}

void CheckDistances(const SceneArguments& arguments, const Scene& scene) {
  const double most = kMostOfDiagonal * scene.Diagonal();
  if (scene.patches.empty()) return;
  for (const SolveOption& option : OptionTable()) {
    if (!option.tiny_distance) continue;
    const double distance = std::get<double>(*option.field.get(arguments.solving));
    if (distance > most)
      throw UsageError(fmt::format(
          "{} {:g} is too far for this scene; give at most {:.3g} m, a thousandth of its diagonal",
          CommandLineName(option), distance, most));
  }
}

std::string CostNote(const SceneArguments& arguments, const ResolvedOptions& resolved) {
  if (arguments.solving.SolverName() != "hierarchical" || arguments.restart ||
      resolved.solver.oracle != "thesis" || arguments.solving.eps)
    return "";
  // Measured at --error 0.02: 99,000 elements for 1,500 in the office, 44,000 for 700 in the Cornell box;
  // with five times the eps fewer than the other oracles make.
  return fmt::format(
      "note: --oracle thesis counts the error of a link without its area: with the eps that follows from "
      "--error, {:.2g} W/m^2, links where surfaces meet are split down to --min-area, which may take a "
      "hundred "
      "times the elements and the time; give --eps, {:.2g} or more, to take less",
      resolved.solver.eps, 5 * resolved.solver.eps);
}

}  // namespace penumbra
