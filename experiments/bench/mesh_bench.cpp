// How fast discontinuities are found, leaves triangulated and points located.
//
// Sample run: penumbra_bench --benchmark_filter=Mesh

#include <benchmark/benchmark.h>

#include <cmath>

#include "mesh/discontinuity.h"
#include "mesh/dset.h"
#include "mesh/irradiance_mesh_builder.h"
#include "mesh/leaf_triangulation.h"
#include "mesh/mesh_locator.h"
#include "solver/base/random.h"

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

}  // namespace
}  // namespace penumbra
