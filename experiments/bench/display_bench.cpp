// How long the parts of a frame take at 1920 x 1080, by the number of triangles and of threads.
//
// Sample run: penumbra_bench --benchmark_filter=Display

#include <benchmark/benchmark.h>

#include <memory>

#include "display/tone_mapping.h"
#include "display/two_pass_display.h"
#include "solver/base/parallel.h"
#include "tests/display/synthetic_room.h"

namespace penumbra {
namespace {

constexpr int kWidth = 1920, kHeight = 1080;

// Cells a side of each of the room's 36 faces: 7 and 202 thousand triangles.
constexpr int kFewCells = 10, kManyCells = 53;

void ByTrianglesAndThreads(benchmark::internal::Benchmark* bench) {
  for (const int cells : {kFewCells, kManyCells})
    for (const int threads : {1, 2}) bench->Args({cells, threads});
  bench->ArgNames({"cells", "threads"})
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MeasureProcessCPUTime();
}

const SyntheticScene& RoomOf(const benchmark::State& state) {
  static std::unique_ptr<SyntheticScene> room;
  static int built = 0;
  const int cells = static_cast<int>(state.range(0));
  if (cells != built) room = std::make_unique<SyntheticScene>(MakeRoom(cells));
  built = cells;
  return *room;
}

struct Setting {
  explicit Setting(benchmark::State& state) : room(RoomOf(state)) {
    SetThreadCount(static_cast<int>(state.range(1)));
    state.counters["triangles"] = static_cast<double>(room.mesh.triangles.size());
  }
  ~Setting() { SetThreadCount(0); }

  const SyntheticScene& room;
  const PixelRays rays = MakePixelRays(RoomCamera(), kWidth, kHeight);
  std::vector<std::uint32_t> ids = std::vector<std::uint32_t>(kWidth * kHeight);
  std::vector<float> s = std::vector<float>(kWidth * kHeight), t = s;
};

void DisplayTriangleIds(benchmark::State& state) {
  Setting setting(state);
  const std::unique_ptr<Passes> passes = SoftwarePasses(setting.room.mesh);
  for (auto _ : state) passes->DrawTriangleIds(setting.rays, kWidth, kHeight, setting.ids);
}
BENCHMARK(DisplayTriangleIds)->Apply(ByTrianglesAndThreads);

void DisplayBarycentric(benchmark::State& state) {
  Setting setting(state);
  const std::unique_ptr<Passes> passes = SoftwarePasses(setting.room.mesh);
  passes->DrawTriangleIds(setting.rays, kWidth, kHeight, setting.ids);
  for (auto _ : state) passes->DrawBarycentrics(setting.ids, setting.s, setting.t);
}
BENCHMARK(DisplayBarycentric)->Apply(ByTrianglesAndThreads);

// The two passes and evaluation, images kept; of these, evaluation.
void DisplayEvaluate(benchmark::State& state) {
  Setting setting(state);
  TwoPassDisplay display(setting.room.scene, setting.room.mesh);
  double evaluate = 0;
  for (auto _ : state) evaluate += display.Render(RoomCamera(), kWidth, kHeight).ms.evaluate;
  state.counters["evaluate_ms"] = evaluate / static_cast<double>(state.iterations());
}
BENCHMARK(DisplayEvaluate)->Apply(ByTrianglesAndThreads);

void DisplayToneMap(benchmark::State& state) {
  Setting setting(state);
  TwoPassDisplay display(setting.room.scene, setting.room.mesh);
  display.Render(RoomCamera(), kWidth, kHeight);
  for (auto _ : state) display.ToneMap({1.0 / 100, true});
}
BENCHMARK(DisplayToneMap)->Apply(ByTrianglesAndThreads);

// Everything, tile by tile.
void DisplayFrame(benchmark::State& state) {
  Setting setting(state);
  TwoPassDisplay display(setting.room.scene, setting.room.mesh);
  FrameTimes sum;
  for (auto _ : state)
    sum += display.RenderScreen(RoomCamera(), kWidth, kHeight, ShadingMode::kRadiosity, {1.0 / 100, true}).ms;
  const auto mean = [&](double total) { return total / static_cast<double>(state.iterations()); };
  state.counters["ids_ms"] = mean(sum.triangle_ids);
  state.counters["barycentric_ms"] = mean(sum.barycentric);
  state.counters["evaluate_ms"] = mean(sum.evaluate);
  state.counters["tone_map_ms"] = mean(sum.tone_map);
}
BENCHMARK(DisplayFrame)->Apply(ByTrianglesAndThreads);

}  // namespace
}  // namespace penumbra
