// What an evaluation of each occlusion method costs, against the number of blockers that matter.

#include <benchmark/benchmark.h>

#include <cmath>
#include <utility>
#include <vector>

#include "solver/base/random.h"
#include "solver/visibility/occlusion_method.h"

namespace penumbra {
namespace {

// A source of 2 x 2 at height 2 over the point, and rectangles before it, turned anyhow, that cover about a
// third of it together. Each meets the source.
struct View {
  DirectionPolygon source;
  std::vector<Cone> cones;
  std::vector<Occluder> occluders;
};

std::vector<View> MakeViews(int blockers) {
  std::vector<View> views(32);
  Random random(701, static_cast<std::uint64_t>(blockers));
  for (View& view : views) {
    for (const Vec3& v : {Vec3(-1, -1, 2), Vec3(1, -1, 2), Vec3(1, 1, 2), Vec3(-1, 1, 2)}) view.source.Add(v);
    view.cones.reserve(static_cast<std::size_t>(blockers));
    while (view.cones.size() < static_cast<std::size_t>(blockers)) {
      const double z = random.Uniform(0.2, 1.8), size = 0.3 * z / std::sqrt(blockers);
      const double x = 0.5 * z * random.Uniform(-1, 1), y = 0.5 * z * random.Uniform(-1, 1);
      const double angle = random.Uniform(0, 6.3);
      const Vec3 u = size * Vec3(std::cos(angle), std::sin(angle), random.Uniform(-0.5, 0.5));
      const Vec3 v = size * Vec3(-std::sin(angle), std::cos(angle), random.Uniform(-0.5, 0.5));
      DirectionPolygon blocker;
      const Vec3 centre(x, y, z);
      for (const auto& [s, t] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
        blocker.Add(centre + s * u + t * v);
      view.cones.push_back(MakeCone({}, blocker, 2));
      if (Classify(view.cones.back(), view.source) == Overlap::kPart)
        view.occluders.push_back(view.cones.back());
      else
        view.cones.pop_back();
    }
  }
  return views;
}

void BM_Occlusion(benchmark::State& state, const char* name) {
  const std::vector<View> views = MakeViews(static_cast<int>(state.range(0)));
  const auto method = MakeOcclusionMethod(name);
  std::size_t i = 0;
  for (auto _ : state) {
    const View& view = views[i++ % views.size()];
    benchmark::DoNotOptimize(method->VisibleFormFactor(view.source, view.occluders, Vec3::UnitZ()));
  }
}
BENCHMARK_CAPTURE(BM_Occlusion, clipping, "clipping")->Arg(5)->Arg(20)->Arg(100);
BENCHMARK_CAPTURE(BM_Occlusion, backprojection, "backprojection")->Arg(5)->Arg(20)->Arg(100);
BENCHMARK_CAPTURE(BM_Occlusion, vertex_tracing, "vertex-tracing")->Arg(5)->Arg(20)->Arg(100);
BENCHMARK_CAPTURE(BM_Occlusion, sampled, "sampled")->Arg(5)->Arg(20)->Arg(100);

}  // namespace
}  // namespace penumbra
