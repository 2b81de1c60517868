// The box in grey that other programs were measured with (experiments/peers): seconds of one core from the
// scene to its interpolants, and what they err by at the 88 reference points.
//
// Sample run, from the root of the checkout: penumbra_bench --benchmark_filter=Peers

#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "experiments/studies/reference_case.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

// RenderPark's hierarchical Galerkin takes 0.47 s for a 95th percentile of 2.6 % with a worst error of 17 %,
// and 2.24 s for 0.78 % and 10 % (programs.csv). The argument is the error asked for, in thousandths.
void PeersBoxInGrey(benchmark::State& state) {
  const ReferenceCase test = LoadReferenceCase("box_grey");
  PipelineOptions options;
  options.error = 1e-3 * static_cast<double>(state.range(0));
  options.refine = RefineBy::kTransport;
  options.max_corrections = 1;
  SetThreadCount(1);
  std::vector<double> errors;
  for (auto _ : state) {
    Pipeline pipeline(test.scene, options);
    pipeline.Solve({});
    pipeline.RefineLight({});
    pipeline.BuildMesh(MeshKind::kInterpolant, {});
    state.PauseTiming();
    errors = ReferenceErrors(test, [&](const ReceiverPoint& at) { return ShownAt(pipeline, at); });
    state.ResumeTiming();
  }
  SetThreadCount(0);
  std::sort(errors.begin(), errors.end());
  state.counters["p95"] = errors[static_cast<std::size_t>(0.95 * static_cast<double>(errors.size()))];
  state.counters["worst"] = errors.back();
}
BENCHMARK(PeersBoxInGrey)->Arg(30)->Arg(10)->Unit(benchmark::kSecond)->Iterations(1);

}  // namespace
}  // namespace penumbra
