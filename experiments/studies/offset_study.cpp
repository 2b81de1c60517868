// Nudges and push-offs against one-sided limits (thesis 6.3, 6.4): the error of the interpolants at contacts.

#include <cmath>

#include <fmt/format.h>

#include "experiments/studies/study.h"
#include "mesh/interpolants/representation_error.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/stopwatch.h"
#include "solver/scene/builtin_scenes.h"

namespace penumbra {
namespace {

struct Offsets {
  std::string method, setting;
  double parameter = StudyRow::kNone;
  double nudge = 0, push_off = 0;  // [m]
};

StudyRow Measure(const Scene& scene, const Offsets& offsets, double error, std::size_t points) {
  PipelineOptions options;
  options.error = error;
  options.point.nudge = offsets.nudge;
  options.point.source_push_off = offsets.push_off;
  Pipeline pipeline(scene, options);
  const Stopwatch stopwatch;
  pipeline.Solve({});
  pipeline.RefineLight({});
  pipeline.BuildMesh(MeshKind::kInterpolant, {});

  StudyRow row;
  row.scene = scene.name;
  row.method = offsets.method;
  row.setting = offsets.setting;
  row.parameter = offsets.parameter;
  row.seconds = stopwatch.Seconds();
  row.triangles = pipeline.report().counts.triangles;
  row.evaluations = pipeline.report().counts.point_evaluations;
  // Against the integral itself, without any distance.
  const PointIrradiance exact(pipeline.solution(), pipeline.visibility());
  const RepresentationError measured = MeasureRepresentationError(
      scene, pipeline.mesh(),
      [&](PatchId patch, const ReceiverPoint& at) { return exact.OnPatch(patch, at); }, points, 1);
  CopyErrors(measured, &row);
  return row;
}

void StudyOffsets(StudyLog& log) {
  const Scene scene = *LoadBuiltinScene(log.quick() ? "floating-cube" : "cornell", {});
  const double error = log.quick() ? 0.1 : 0.05;
  const std::size_t points = log.quick() ? 200 : 4000;
  std::vector<Offsets> all = {{"limits", "no distance", StudyRow::kNone, 0, 0}};
  for (const double distance :
       log.quick() ? std::vector<double>{1e-3} : std::vector<double>{1e-9, 1e-7, 1e-5, 1e-3}) {
    const double length = distance * scene.Diagonal();
    all.push_back({"nudge", fmt::format("{:g} of the diagonal", distance), distance, length, 0});
    all.push_back({"push-off", fmt::format("{:g} of the diagonal", distance), distance, 0, length});
  }
  double limits = 0, best = 0;
  std::string best_name;
  for (const Offsets& offsets : all) {
    StudyRow row = Measure(scene, offsets, error, points);
    if (offsets.method == "limits") {
      limits = row.error_p99;
    } else if (best_name.empty() || row.error_p99 < best) {
      best = row.error_p99;
      best_name = offsets.method + ", " + offsets.setting;
    }
    log.Add(std::move(row));
  }
  log.Find(
      fmt::format("In {} the 99th percentile of the interpolants' error is {:.3g} with limits and {:.3g} "
                  "with the best distance tried ({}).",
                  scene.name, limits, best, best_name));
}

}  // namespace

extern const Study kOffsetStudy;
const Study kOffsetStudy = {"offsets",
                            "Samples at contacts: limits from one side against distances; interpolants' "
                            "error against exact irradiance",
                            "Nudging samples into their triangle and pushing sources off a contact keeps "
                            "samples from the wrong side (Hardt 1996, "
                            "6.3 and 6.4). Limits decided by the direction of approach need no distance and "
                            "are right at every scale.",
                            "parameter",
                            "error_p99",
                            StudyOffsets};

}  // namespace penumbra
