// How long it takes to find which patches see each other, and how that grows with what cannot be seen.
//
// Sample run: penumbra_bench --benchmark_filter=Pairs

#include <benchmark/benchmark.h>

#include "experiments/bench/bench_scenes.h"
#include "solver/base/parallel.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {
namespace {

void PairsInRooms(benchmark::State& state) {
  const Scene scene = Rooms(static_cast<int>(state.range(0)));
  SetThreadCount(1);
  std::size_t pairs = 0, blockers = 0;
  for (auto _ : state) {
    const PatchVisibility visibility(scene);
    pairs = blockers = 0;
    for (std::size_t p = 0; p < scene.patches.size(); ++p)
      for (const PatchPair& pair : visibility.SourcesOf(static_cast<PatchId>(p))) {
        ++pairs;
        blockers += pair.blocker_count;
      }
  }
  SetThreadCount(0);
  state.counters["patches"] = static_cast<double>(scene.patches.size());
  state.counters["pairs"] = static_cast<double>(pairs);
  state.counters["blockers_a_pair"] = static_cast<double>(blockers) / static_cast<double>(pairs);
}
BENCHMARK(PairsInRooms)->Arg(1)->Arg(3)->Arg(10)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace penumbra
