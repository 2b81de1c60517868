// How fast discontinuities are found, leaves triangulated and points located.
//
// Sample run: penumbra_bench --benchmark_filter=Mesh

#include <benchmark/benchmark.h>

#include <atomic>
#include <cmath>

#include "experiments/studies/reference_case.h"
#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/dset.h"
#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "mesh/interpolants/mesh_locator.h"
#include "mesh/pipeline/pipeline.h"
#include "mesh/refinement/local_pass.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "mesh/triangulation/weld.h"
#include "solver/base/parallel.h"
#include "solver/base/random.h"
#include "solver/scene/builtin_scenes.h"

namespace penumbra {
namespace {

void AddPatch(Scene& scene, const Polygon3& vertices) {
  scene.patches.push_back(MakePatch(vertices, 0, 0, {static_cast<std::int32_t>(scene.patches.size())}));
}

// A floor under a square light, with a grid of `n` by `n` square boards between them.
Scene Boards(int n) {
  Scene scene;
  scene.materials = {Material{}};
  scene.objects = {Object{"boards", {}}};
  AddPatch(scene, {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}});
  AddPatch(scene, {{-0.5, -0.5, 4}, {-0.5, 0.5, 4}, {0.5, 0.5, 4}, {0.5, -0.5, 4}});
  Random random(1);
  const double cell = 4.0 / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = -2 + cell * (i + 0.5), y = -2 + cell * (j + 0.5), z = random.Uniform(0.2, 1.5);
      const double angle = random.Uniform(0, 3), r = 0.4 * cell;
      Polygon3 board;
      for (int k = 0; k < 4; ++k)
        board.push_back({x + r * std::cos(angle + k * M_PI / 2), y + r * std::sin(angle + k * M_PI / 2), z});
      AddPatch(scene, board);
    }
  return scene;
}

std::vector<double> LightOnly(const Scene& scene) {
  std::vector<double> strength(scene.patches.size(), 0.0);
  strength[1] = 1;
  return strength;
}

ElementForest EvenForest(const Scene& scene, int levels) {
  ElementForest forest(scene);
  for (int level = 0; level < levels; ++level)
    for (const ElementId leaf : forest.Leaves(0)) forest.Subdivide(leaf);
  return forest;
}

void MeshDiscontinuities(benchmark::State& state) {
  const Scene scene = Boards(static_cast<int>(state.range(0)));
  const PatchVisibility visibility(scene);
  const DiscontinuityFinder finder(scene, visibility);
  const std::vector<double> strength = LightOnly(scene);
  std::size_t found = 0;
  for (auto _ : state) found += finder.Find(0, strength, {}).size();
  state.counters["discontinuities"] =
      benchmark::Counter(static_cast<double>(found), benchmark::Counter::kIsRate);
}
BENCHMARK(MeshDiscontinuities)->Arg(1)->Arg(4)->Arg(10)->Unit(benchmark::kMillisecond);

void MeshActivation(benchmark::State& state) {
  const Scene scene = Boards(static_cast<int>(state.range(0)));
  const PatchVisibility visibility(scene);
  const auto found = DiscontinuityFinder(scene, visibility).Find(0, LightOnly(scene), {});
  const ElementForest forest = EvenForest(scene, 6);
  for (auto _ : state) benchmark::DoNotOptimize(ActivateDiscontinuities(forest, 0, found, {}).dsets_active);
  state.counters["discontinuities"] =
      benchmark::Counter(static_cast<double>(found.size()) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate);
}
BENCHMARK(MeshActivation)->Arg(1)->Arg(4)->Arg(10)->Unit(benchmark::kMillisecond);

void MeshLeafTriangulation(benchmark::State& state) {
  const Scene scene = Boards(4);
  const PatchVisibility visibility(scene);
  const auto found = DiscontinuityFinder(scene, visibility).Find(0, LightOnly(scene), {});
  const ElementForest forest = EvenForest(scene, static_cast<int>(state.range(0)));
  const PatchDSets dsets = ActivateDiscontinuities(forest, 0, found, {});
  std::size_t triangles = 0;
  for (auto _ : state) triangles += TriangulateLeaves(forest, 0, dsets).triangles.size();
  state.counters["triangles"] =
      benchmark::Counter(static_cast<double>(triangles), benchmark::Counter::kIsRate);
  state.counters["leaves"] =
      benchmark::Counter(static_cast<double>(dsets.leaves.size()) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate);
}
// Rates are those of one core: of all threads' time.
BENCHMARK(MeshLeafTriangulation)
    ->Arg(3)
    ->Arg(5)
    ->Arg(7)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

void MeshLocate(benchmark::State& state) {
  const Scene scene = Boards(4);
  const PatchVisibility visibility(scene);
  const auto found = DiscontinuityFinder(scene, visibility).Find(0, LightOnly(scene), {});
  const ElementForest forest = EvenForest(scene, 5);
  std::vector<PatchTriangulation> patches;
  for (PatchId p = 0; p < static_cast<PatchId>(scene.patches.size()); ++p)
    patches.push_back(TriangulateLeaves(
        forest, p, ActivateDiscontinuities(forest, p, p == 0 ? found : std::vector<Discontinuity>{}, {})));
  const std::vector<Rgb> irradiance(forest.size(), Rgb::Ones());
  const IrradianceMesh mesh = BuildConstantMesh(patches, irradiance);
  const MeshLocator locator(scene, mesh);
  Random random(1);
  for (auto _ : state)
    benchmark::DoNotOptimize(locator.Find(0, {random.Uniform(-4, 4), random.Uniform(-4, 4), 0}));
}
BENCHMARK(MeshLocate);

// The office as the thesis's settings solve it, once.
struct SolvedOffice {
  SolvedOffice() { pipeline.Solve({}); }
  Scene scene = *LoadBuiltinScene("office", {});
  Pipeline pipeline = Pipeline(scene, ThesisSettings());

  // What its discontinuities are, of at least the weight in the thesis's sense [W/m^2].
  std::vector<PatchDSets> DSets(double min_weight, std::size_t* found_in_all) const {
    DiscontinuityOptions options = pipeline.resolved().discontinuities;
    options.min_weight = min_weight;
    const DiscontinuityFinder finder(scene, pipeline.visibility());
    const std::vector<double> strength = SourceStrengths(pipeline.solution());
    std::vector<PatchDSets> dsets(scene.patches.size());
    std::atomic<std::size_t> count = 0;
    ParallelFor(dsets.size(), 1, [&](std::size_t p) {
      const auto patch = static_cast<PatchId>(p);
      const auto found = finder.Find(patch, strength, options);
      count += found.size();
      dsets[p] = ActivateDiscontinuities(pipeline.solution().forest, patch, found, options);
    });
    *found_in_all = count;
    return dsets;
  }

  static const SolvedOffice& Get() {
    static const SolvedOffice office;
    return office;
  }
};

// Finding and ranking discontinuities on all patches, on all threads (the CPU column adds them up): the
// argument is their least weight, 100 W/m^2 as in the thesis, or 0 for all that there are.
void MeshOfficeDiscontinuities(benchmark::State& state) {
  const SolvedOffice& office = SolvedOffice::Get();
  std::size_t found = 0;
  for (auto _ : state) benchmark::DoNotOptimize(office.DSets(static_cast<double>(state.range(0)), &found));
  state.counters["discontinuities"] = static_cast<double>(found);
}
BENCHMARK(MeshOfficeDiscontinuities)
    ->Arg(100)
    ->Arg(0)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

// Triangulating all leaves anew, on all threads; "a triangle" is the time that passes for each.
void MeshOfficeTriangulation(benchmark::State& state) {
  const SolvedOffice& office = SolvedOffice::Get();
  const ElementForest& forest = office.pipeline.solution().forest;
  std::size_t found = 0;
  const std::vector<PatchDSets> dsets = office.DSets(static_cast<double>(state.range(0)), &found);
  std::vector<PatchTriangulation> patches(dsets.size());
  double triangles = 0;
  for (auto _ : state) {
    std::vector<PatchBorders> borders(dsets.size());
    ParallelFor(dsets.size(), 1,
                [&](std::size_t p) { borders[p] = PatchBorders(forest, static_cast<PatchId>(p), dsets[p]); });
    WeldOutlines(office.scene, borders);
    ParallelFor(dsets.size(), 1, [&](std::size_t p) {
      patches[p] = TriangulateLeaves(forest, static_cast<PatchId>(p), dsets[p], std::move(borders[p]));
    });
    for (const PatchTriangulation& patch : patches) triangles += static_cast<double>(patch.triangles.size());
  }
  state.counters["a triangle"] =
      benchmark::Counter(triangles, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(MeshOfficeTriangulation)
    ->Arg(100)
    ->Arg(0)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace penumbra
