// How long irradiance at a point takes, and how far it is off: one polygon, one source behind blockers by
// each method, many sources, a furnished scene, and scenes that grow where the point cannot see.
//
// Sample run: penumbra_bench --benchmark_filter=Point

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "experiments/bench/bench_scenes.h"
#include "solver/base/random.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/surface_points.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/sources/source_set.h"
#include "solver/visibility/exact/backprojection.h"
#include "solver/visibility/exact/occlusion_methods.h"
#include "solver/visibility/point/form_factor.h"
#include "solver/visibility/point/form_factor_batch.h"
#include "solver/visibility/point/occlusion_method.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {
namespace {

ReceiverPoint OnFloor(double x, double y) { return {Vec3(x, y, 0), Vec3::UnitZ(), Vec3::Zero(), 0}; }

// Quadrilaterals that face the origin from all around above it.
std::vector<Polygon3> Quadrilaterals(int count) {
  Random random(2);
  std::vector<Polygon3> all;
  for (int i = 0; i < count; ++i) {
    const double angle = random.Uniform(0, 2 * std::numbers::pi), z = random.Uniform(0.2, 1);
    const Vec3 towards(std::cos(angle), std::sin(angle), z);
    const Vec3 u = towards.unitOrthogonal(), v = towards.normalized().cross(u);
    const Vec3 centre = random.Uniform(1, 4) * towards.normalized();
    const double a = random.Uniform(0.1, 0.3), b = random.Uniform(0.1, 0.3);
    all.push_back({centre + a * u, centre - b * v, centre - a * u, centre + b * v});
  }
  return all;
}

void PointQuadrilateral(benchmark::State& state) {
  const std::vector<Polygon3> all = Quadrilaterals(256);
  const ReceiverPoint at = OnFloor(0, 0);
  for (auto _ : state) {
    double sum = 0;
    for (const Polygon3& polygon : all) sum += FormFactor(Seen(at, polygon, true), at.normal);
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}
BENCHMARK(PointQuadrilateral);

void PointQuadrilateralBatched(benchmark::State& state) {
  const std::vector<Polygon3> all = Quadrilaterals(256);
  PolygonBatch batch;
  for (const Polygon3& polygon : all) batch.Add(polygon);
  const ReceiverPoint at = OnFloor(0, 0);
  std::vector<double> factor(all.size());
  for (auto _ : state) {
    FormFactors(batch, 0, batch.size(), at.position, at.normal, factor.data());
    benchmark::DoNotOptimize(factor.data());
  }
  double worst = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    worst = std::max(worst, std::abs(factor[i] / FormFactor(Seen(at, all[i], true), at.normal) - 1));
  state.counters["error"] = worst;
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}
BENCHMARK(PointQuadrilateralBatched);

void TimeAnywhere(benchmark::State& state, const PointIrradiance& irradiance,
                  const std::vector<ReceiverPoint>& points) {
  for (auto _ : state) {
    Rgb sum = Rgb::Zero();
    for (const ReceiverPoint& at : points) sum += irradiance.Anywhere(at).irradiance;
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
}

constexpr int kPoints = 16;  // around the origin, so that no single arrangement counts

// One source behind boards, all of which cover some of it. `error`: the largest difference from the exact
// backprojection, relative to the light without boards.
void PointBlockers(benchmark::State& state, const std::string& name) {
  const auto n = static_cast<int>(state.range(0));
  const Scene scene = LightAndBoards(n);
  std::vector<PatchId> boards;
  for (int i = 1; i <= n; ++i) boards.push_back(i);
  std::vector<ReceiverPoint> points;
  for (int i = 0; i < kPoints; ++i) points.push_back(OnFloor(0.02 * i, 0.013 * i));
  const std::unique_ptr<const OcclusionMethod> method = OcclusionMethods().Make(name, {});
  for (auto _ : state) {
    double sum = 0;
    for (const ReceiverPoint& at : points) sum += VisibleFactor(scene, boards, at, *method);
    benchmark::DoNotOptimize(sum);
  }
  double worst = 0;
  const Backprojection reference;
  for (const ReceiverPoint& at : points)
    worst = std::max(worst, std::abs(VisibleFactor(scene, boards, at, *method) -
                                     VisibleFactor(scene, boards, at, reference)) /
                                VisibleFactor(scene, {}, at, reference));
  state.counters["error"] = worst;
  state.SetItemsProcessed(state.iterations() * kPoints);
}
void Blockers(benchmark::internal::Benchmark* benchmark) {
  for (const int n : {1, 5, 20, 100, 300, 1000}) benchmark->Arg(n);
}
BENCHMARK_CAPTURE(PointBlockers, clipping, "clipping")->Apply(Blockers);
BENCHMARK_CAPTURE(PointBlockers, backprojection, "backprojection")->Apply(Blockers);
BENCHMARK_CAPTURE(PointBlockers, vertex_tracing, "vertex-tracing")->Apply(Blockers);
BENCHMARK_CAPTURE(PointBlockers, sampled, "sampled")->Apply(Blockers);

// `n` by `n` lights under the ceiling of a hall and 100 boxes below them: every light a source of its own, as
// the leaves of a solution are. By the default way, and by methods that are asked about each light.
void PointSources(benchmark::State& state, const std::string& name) {
  const auto n = static_cast<int>(state.range(0));
  Scene scene;
  scene.materials = GreyAndLight();
  const double cell = 10.0 / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = cell * i, y = cell * j, s = 0.9 * cell;
      AddPatch(scene, {{x, y, 4}, {x, y + s, 4}, {x + s, y + s, 4}, {x + s, y, 4}}, 1);
    }
  Random random(6);
  for (int k = 0; k < 100; ++k) {
    const Vec3 low(random.Uniform(0, 9), random.Uniform(0, 9), random.Uniform(0.2, 2));
    AddBox(scene, low, low + Vec3(random.Uniform(0.1, 1), random.Uniform(0.1, 1), random.Uniform(0.1, 1)),
           false);
  }
  const std::unique_ptr<const OcclusionMethod> method =
      name == "auto" ? nullptr : OcclusionMethods().Make(name, {});
  const PatchVisibility unused;
  PointIrradianceOptions options;
  options.method = method.get();
  const PointIrradiance irradiance(scene, unused, SourceSet::Emitters(scene), options);
  const PointIrradiance reference(scene, unused, SourceSet::Emitters(scene));
  std::vector<ReceiverPoint> points;
  for (int k = 0; k < kPoints; ++k) points.push_back(OnFloor(random.Uniform(0, 10), random.Uniform(0, 10)));
  TimeAnywhere(state, irradiance, points);
  double worst = 0;
  for (const ReceiverPoint& at : points)
    worst = std::max(
        worst, (irradiance.Anywhere(at).irradiance - reference.Anywhere(at).irradiance).abs().maxCoeff());
  state.counters["difference_from_auto"] = worst;
}
BENCHMARK_CAPTURE(PointSources, auto, "auto") -> Arg(1) -> Arg(3) -> Arg(10) -> Arg(30)
    -> Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(PointSources, sampled, "sampled")->Arg(1)->Arg(3)->Arg(10)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(PointSources, vertex_tracing, "vertex-tracing")
    ->Arg(1)
    ->Arg(3)
    ->Arg(10)
    ->Unit(benchmark::kMicrosecond);

// Direct light at points all over the fronts that look up, every emitter and every blocker looked at: 10 us.
void PointOffice(benchmark::State& state) {
  const Scene scene = *LoadBuiltinScene("office", {});
  const PatchVisibility unused;
  const PointIrradiance irradiance(scene, unused, SourceSet::Emitters(scene));
  std::vector<ReceiverPoint> points;
  for (const SurfacePoint& p : SpreadPoints(scene, 2000, 1))
    if (scene.patches[p.patch].normal.z() > 0.99 && p.position.z() < 0.01)
      points.push_back({p.position, Vec3::UnitZ(), Vec3::Zero(), 0});
  TimeAnywhere(state, irradiance, points);
  state.counters["patches"] = static_cast<double>(scene.patches.size());
}
BENCHMARK(PointOffice)->Unit(benchmark::kMicrosecond);

// Direct light at points of one room of many: what cannot be seen should not cost.
void PointRooms(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  const Scene scene = Rooms(n);
  const PatchVisibility unused;
  const PointIrradiance irradiance(scene, unused, SourceSet::Emitters(scene));
  Random random(5);
  std::vector<ReceiverPoint> points;
  const double origin = 4.2 * (n / 2);
  for (int i = 0; i < 256; ++i)
    points.push_back({Vec3(origin + random.Uniform(0.01, 3.99), origin + random.Uniform(0.01, 3.99), 0),
                      Vec3::UnitZ(), Vec3::Zero(), 0});
  TimeAnywhere(state, irradiance, points);
  state.counters["patches"] = static_cast<double>(scene.patches.size());
}
BENCHMARK(PointRooms)->Arg(1)->Arg(3)->Arg(10)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace penumbra
