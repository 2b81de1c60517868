// Point irradiance past blockers: four methods, error against time (thesis, chapter 6).

#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "experiments/bench/bench_scenes.h"
#include "experiments/studies/study.h"
#include "solver/visibility/exact/backprojection.h"
#include "solver/visibility/exact/occlusion_methods.h"
#include "solver/visibility/point/sampled_visibility.h"

namespace penumbra {
namespace {

constexpr int kReceivers = 16;  // around the origin, so that no single arrangement counts

struct Boards {
  Scene scene;
  std::vector<PatchId> boards;
  std::vector<ReceiverPoint> points;
  std::vector<double> truth;  // by exact rationals
  std::vector<double> unhidden;
};

Boards MakeBoards(int n) {
  Boards b{LightAndBoards(n), {}, {}, {}, {}};
  for (int i = 1; i <= n; ++i) b.boards.push_back(i);
  for (int i = 0; i < kReceivers; ++i)
    b.points.push_back({Vec3(0.02 * i, 0.013 * i, 0), Vec3::UnitZ(), Vec3::Zero(), 0});
  const Backprojection reference;
  for (const ReceiverPoint& at : b.points) {
    b.truth.push_back(VisibleFactor(b.scene, b.boards, at, reference));
    b.unhidden.push_back(VisibleFactor(b.scene, {}, at, reference));
  }
  return b;
}

StudyRow Measure(const Boards& b, const std::string& method_name, const OcclusionMethod& method,
                 double seconds) {
  StudyRow row;
  row.scene = fmt::format("{} boards", b.boards.size());
  row.method = method_name;
  row.parameter = static_cast<double>(b.boards.size());
  row.seconds = SecondsPerCall(seconds,
                               [&] {
                                 for (const ReceiverPoint& at : b.points)
                                   VisibleFactor(b.scene, b.boards, at, method);
                               }) /
                kReceivers;
  std::vector<double> errors;
  for (std::size_t i = 0; i < b.points.size(); ++i)
    errors.push_back(std::abs(VisibleFactor(b.scene, b.boards, b.points[i], method) - b.truth[i]) /
                     b.unhidden[i]);
  SetErrors(std::move(errors), &row);
  return row;
}

void StudyPointIrradiance(StudyLog& log) {
  const double seconds = log.quick() ? 0.01 : 0.3;
  double clipping = 0, backprojection = 0;
  for (const int n : log.quick() ? std::vector<int>{5} : std::vector<int>{1, 5, 20, 100}) {
    const Boards b = MakeBoards(n);
    for (const std::string name : {"clipping", "vertex-tracing", "backprojection"}) {
      StudyRow row = Measure(b, name, *OcclusionMethods().Make(name, {}), seconds);
      if (name == "clipping") clipping = row.seconds;
      if (name == "backprojection") backprojection = row.seconds;
      row.setting = "exact";
      log.Add(std::move(row));
    }
    std::vector<double> time, error;
    for (const int divisions :
         log.quick() ? std::vector<int>{16} : std::vector<int>{4, 8, 16, 32, 64, 128, 256}) {
      StudyRow row = Measure(b, "sampled", SampledVisibility(divisions), seconds);
      row.setting = fmt::format("{0} x {0} samples", divisions);
      time.push_back(row.seconds);
      error.push_back(row.error_rms);
      log.Add(std::move(row));
    }
    log.Find(
        fmt::format("{} boards: clipping takes {:.3g} us a point, {:.0f} times less than exact "
                    "backprojection.",
                    n, 1e6 * clipping, backprojection / clipping));
    if (time.size() < 2) continue;
    const double slope = LogSlope(time, error);
    const double decades = std::log10(error.back() / 1e-6) / -slope;
    log.Find(
        fmt::format("{} boards: the error of sampling falls with the power {:.2f} of its time; {:.2g} is "
                    "reached in {:.3g} ms, and 1e-6 would take some {:.2g} s a point.",
                    n, slope, error.back(), 1e3 * time.back(), time.back() * std::pow(10, decades)));
  }
}

}  // namespace

extern const Study kPointIrradianceStudy;
const Study kPointIrradianceStudy = {
    "point-irradiance",
    "Irradiance at a point past blockers, by method; errors relative to the unhidden source",
    "Sampling the source is noisy and slow, and backprojection by triangulation makes point irradiance exact "
    "(Hardt "
    "1996, chapter 6). Cutting convex shadows out of the source is as exact and faster.",
    "seconds",
    "error_max",
    StudyPointIrradiance};

}  // namespace penumbra
