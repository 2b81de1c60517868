#include "mesh/refinement/source_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "mesh/interpolants/representation_error.h"
#include "solver/base/parallel.h"
#include "solver/scene/scene_parts.h"
#include "solver/scene/surface_points.h"

namespace penumbra {
namespace {

constexpr std::size_t kPointGrain = 4;
// Scores that are tried: the finest times powers of this.
constexpr double kStep = 1.189207115002721;
constexpr std::size_t kSteps = 36;

}  // namespace

SourceCut ChooseSourceCut(const RadiositySolution& solution, const SourceCells& cells,
                          const PointIrradiance& exact, double finest, double error, std::size_t points,
                          std::uint64_t seed, const ExecutionContext& context) {
  const Scene& scene = solution.forest.scene();
  const std::span<const SourceCell> all = cells.cells();
  SourceCut chosen;
  if (all.empty() || points == 0) return chosen;

  const std::vector<std::int32_t> fine_cut = cells.Cut(0);
  const PointIrradiance fine =
      exact.WithSources(SourceSet::FromSolution(solution, cells.Fragments(fine_cut, /*whole_leaves=*/true)));
  const SourceSet& sources = fine.sources();
  std::vector<double> scores;
  for (std::size_t j = 0; j < kSteps; ++j) scores.push_back(finest * std::pow(kStep, static_cast<double>(j)));
  const auto step_of = [&](double score) {  // the first that accepts it
    return static_cast<std::size_t>(std::lower_bound(scores.begin(), scores.end(), score) - scores.begin());
  };
  std::vector<std::size_t> accepted_at(all.size());
  std::vector<Rgb> reflectance(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    accepted_at[i] = all[i].skip == 1 ? 0 : step_of(all[i].score);
    reflectance[i] = scene.MaterialOf(solution.forest[all[i].leaf].patch).reflectance;
  }

  const std::vector<SurfacePoint> at = SpreadPoints(scene, SeenAreas(scene), points, seed);
  std::vector<Rgb> truth(points);
  std::vector<std::vector<Rgb>> shown(kSteps, std::vector<Rgb>(points));
  ParallelFor(points, kPointGrain, [&](std::size_t p) {
    if (context.Cancelled()) return;
    ReceiverPoint receiver;
    receiver.position = at[p].position;
    receiver.normal = scene.patches[static_cast<std::size_t>(at[p].patch)].normal;
    thread_local std::vector<double> factor, of_cell;
    thread_local std::vector<Rgb> light;
    factor.resize(sources.LeafRadiosities().size());
    truth[p] = fine.OnPatch(at[p].patch, receiver, factor);
    of_cell.assign(all.size(), 0.0);
    light.assign(all.size(), Rgb::Zero());
    for (std::size_t s = 0; s < factor.size(); ++s) {
      const std::int32_t fragment = sources.FragmentOf(static_cast<std::int32_t>(s));
      if (factor[s] == 0 || fragment < 0) continue;
      const auto cell = static_cast<std::size_t>(fine_cut[static_cast<std::size_t>(fragment)]);
      of_cell[cell] += factor[s];
      light[cell] += factor[s] * all[cell].irradiance;
    }
    std::array<Rgb, kSteps + 1> change;  // of the error from one score to the next
    change.fill(Rgb::Zero());
    for (std::size_t i = all.size(); i-- > 0;) {
      if (of_cell[i] == 0) continue;
      const std::int32_t parent = all[i].parent;
      const std::size_t until = parent < 0 ? kSteps : accepted_at[static_cast<std::size_t>(parent)];
      if (accepted_at[i] < until) {
        const Rgb excess = reflectance[i] * (of_cell[i] * all[i].irradiance - light[i]);
        change[accepted_at[i]] += excess;
        change[until] -= excess;
      }
      if (parent < 0) continue;
      of_cell[static_cast<std::size_t>(parent)] += of_cell[i];
      light[static_cast<std::size_t>(parent)] += light[i];
    }
    const double gain = fine.Reverberation(at[p].patch, receiver);
    Rgb sum = truth[p];
    for (std::size_t j = 0; j < kSteps; ++j) shown[j][p] = sum += gain * change[j];
  });

  for (std::size_t j = 0; j < kSteps && !context.Cancelled(); ++j) {
    const double p99 = Quantile(SeenErrors(scene, at, shown[j], truth), 0.99);
    if (j > 0 && p99 > error) break;
    chosen.score = scores[j];
    chosen.p99 = p99;
  }
  return chosen;
}

}  // namespace penumbra
