// Whether the error that a user names is the error that a user gets: against path-traced references, and
// against exact irradiance from the sources of a finer solution at points that nothing was made of.

#include <fmt/format.h>

#include <vector>

#include "experiments/studies/reference_case.h"
#include "experiments/studies/study.h"
#include "mesh/interpolants/representation_error.h"
#include "mesh/pipeline/pipeline.h"

namespace penumbra {
namespace {

// A solution that others are measured by has this part of their error, or of the smallest asked for.
constexpr double kFiner = 0.5;
constexpr std::size_t kFreshPoints = 10'000, kQuickFreshPoints = 500;
constexpr std::uint64_t kFreshSeed = 77;  // of points that no solve has seen

Measured SolveFor(const ReferenceCase& test, double error) {
  PipelineOptions options;
  options.error = error;
  return MeasurePipeline(test, options, 1);
}

void Climb(StudyLog& log, const ReferenceCase& test, const std::vector<double>& ladder) {
  const Measured finer = SolveFor(test, kFiner * ladder.back());
  const IrradianceSampler truth = [&](PatchId patch, const ReceiverPoint& at) {
    return finer.pipeline->irradiance().OnPatch(patch, at);
  };
  int met = 0, met_fresh = 0, told = 0, wasteful = 0;
  for (const double error : ladder) {
    Measured solved = SolveFor(test, error);
    Pipeline& pipeline = *solved.pipeline;
    pipeline.Measure({});
    StudyRow& traced = solved.row;
    traced.method = "against the path tracer";
    traced.setting = fmt::format("--error {:g}", error);
    traced.parameter = error;
    StudyRow row = traced;
    row.method = "against a finer solution";
    const std::size_t points = log.quick() ? kQuickFreshPoints : kFreshPoints;
    const RepresentationError fresh =
        MeasureRepresentationError(test.scene, pipeline.mesh(), truth, points, kFreshSeed);
    CopyErrors(fresh, &row);
    met += traced.error_p99 <= error ? 1 : 0;
    met_fresh += row.error_p99 <= error ? 1 : 0;
    told += pipeline.report().error_met == (row.error_p99 <= error) ? 1 : 0;
    constexpr double kWasteful = 0.2;
    wasteful += row.error_p99 < kWasteful * error ? 1 : 0;
    log.Add(std::move(traced));
    log.Add(std::move(row));
  }
  log.Find(
      fmt::format("{}: of {} errors asked for, {} were kept at the path tracer's {} points and {} at fresh "
                  "random points; the report's `met` agreed with the latter for {}; {} were kept by more "
                  "than a factor of five.",
                  test.name, ladder.size(), met, test.points.size(), met_fresh, told, wasteful));
}

void StudyErrorLadder(StudyLog& log) {
  if (log.quick()) return Climb(log, LoadReferenceCase("floating-cube"), {0.1});
  for (const char* name : {"floating-cube", "box", "cornell"})
    Climb(log, LoadReferenceCase(name), {0.05, 0.02, 0.01, 0.005});
  Climb(log, LoadReferenceCase("office"), {0.05, 0.02, 0.01});  // 0.0025 would take many minutes
}

}  // namespace

extern const Study kErrorLadderStudy;
const Study kErrorLadderStudy = {
    "error-ladder",
    "Seconds of processors against the 99th percentile of the error of what is shown, for the "
    "whole light",
    "The error that a user names is the error that a user gets, told truthfully, "
    "and not much less than that.",
    "seconds",
    "error_p99",
    StudyErrorLadder};

}  // namespace penumbra
