#include "mesh/refinement/source_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "mesh/interpolants/representation_error.h"
#include "solver/base/parallel.h"
#include "solver/base/scratch.h"
#include "solver/scene/scene_parts.h"
#include "solver/scene/surface_points.h"

namespace penumbra {
namespace {

constexpr std::size_t kPointGrain = 4;
// The scores that are tried are the finest times powers of this.
constexpr double kStep = 1.189207115002721;
constexpr std::size_t kSteps = 36;

// The scores from the finest upwards, in steps of kStep.
std::vector<double> ScoresFrom(double finest) {
  std::vector<double> scores;
  for (std::size_t j = 0; j < kSteps; ++j) scores.push_back(finest * std::pow(kStep, static_cast<double>(j)));
  return scores;
}

// The contributions of cells at a point: each cell's form factor, and its light if its finest parts have
// their own irradiance.
struct LightByCell {
  std::vector<double> leaf_factor;  // indexed by leaf of the finest sources
  std::vector<double> factor;
  std::vector<Rgb> light;

  void Clear() {
    leaf_factor.clear();
    factor.clear();
    light.clear();
  }
};

// The irradiance at points from the cuts of all scores.
class CutTrial {
 public:
  CutTrial(const RadiositySolution& solution, const SourceCells& cells, const PointIrradiance& exact,
           const std::vector<double>& scores)
      : cells_(cells.cells()),
        fine_cut_(cells.Cut(0)),
        fine_(exact.WithSources(
            SourceSet::FromSolution(solution, cells.Fragments(fine_cut_, /*whole_leaves=*/true)))),
        scene_(solution.forest.scene()),
        accepted_at_(cells_.size()),
        reflectance_(cells_.size()) {
    const auto step_of = [&](double score) {  // the first step that accepts it
      return static_cast<std::size_t>(std::lower_bound(scores.begin(), scores.end(), score) - scores.begin());
    };
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      accepted_at_[i] = cells_[i].skip == 1 ? 0 : step_of(cells_[i].score);
      reflectance_[i] = scene_.MaterialOf(solution.forest[cells_[i].leaf].patch).reflectance;
    }
  }

  struct Irradiance {
    Rgb truth;                      // from the finest sources
    std::array<Rgb, kSteps> shown;  // from the cut of each score, including the return of its error
  };
  Irradiance At(const SurfacePoint& at) const;

 private:
  Rgb LookAtCells(PatchId patch, const ReceiverPoint& receiver, LightByCell& cells) const;
  std::array<Rgb, kSteps + 1> Changes(LightByCell& cells) const;

  std::span<const SourceCell> cells_;
  std::vector<std::int32_t> fine_cut_;
  PointIrradiance fine_;
  const Scene& scene_;
  std::vector<std::size_t> accepted_at_;  // by cell: the first step whose cut contains the whole cell
  std::vector<Rgb> reflectance_;          // by cell
};

// Returns the irradiance from the finest sources, and fills `cells` with its parts for the cells of the
// finest cut.
Rgb CutTrial::LookAtCells(PatchId patch, const ReceiverPoint& receiver, LightByCell& cells) const {
  const SourceSet& sources = fine_.sources();
  cells.leaf_factor.resize(sources.LeafRadiosities().size());
  const Rgb irradiance = fine_.OnPatch(patch, receiver, cells.leaf_factor);
  cells.factor.assign(cells_.size(), 0.0);
  cells.light.assign(cells_.size(), Rgb::Zero());
  for (std::size_t s = 0; s < cells.leaf_factor.size(); ++s) {
    const std::int32_t fragment = sources.FragmentOf(static_cast<std::int32_t>(s));
    if (cells.leaf_factor[s] == 0 || fragment < 0) continue;
    const auto cell = static_cast<std::size_t>(fine_cut_[static_cast<std::size_t>(fragment)]);
    cells.factor[cell] += cells.leaf_factor[s];
    cells.light[cell] += cells.leaf_factor[s] * cells_[cell].irradiance;
  }
  return irradiance;
}

// The change of the irradiance from each score to the next. Adds the contributions of children to their
// parents.
std::array<Rgb, kSteps + 1> CutTrial::Changes(LightByCell& cells) const {
  std::array<Rgb, kSteps + 1> change;
  change.fill(Rgb::Zero());
  for (std::size_t i = cells_.size(); i-- > 0;) {
    if (cells.factor[i] == 0) continue;
    const std::int32_t parent = cells_[i].parent;
    const std::size_t until = parent < 0 ? kSteps : accepted_at_[static_cast<std::size_t>(parent)];
    if (accepted_at_[i] < until) {
      const Rgb excess = reflectance_[i] * (cells.factor[i] * cells_[i].irradiance - cells.light[i]);
      change[accepted_at_[i]] += excess;
      change[until] -= excess;
    }
    if (parent < 0) continue;
    cells.factor[static_cast<std::size_t>(parent)] += cells.factor[i];
    cells.light[static_cast<std::size_t>(parent)] += cells.light[i];
  }
  return change;
}

CutTrial::Irradiance CutTrial::At(const SurfacePoint& at) const {
  ReceiverPoint receiver;
  receiver.position = at.position;
  receiver.normal = scene_.patches[static_cast<std::size_t>(at.patch)].normal;
  const Scratch<LightByCell> cells;
  Irradiance irradiance;
  irradiance.truth = LookAtCells(at.patch, receiver, *cells);
  const std::array<Rgb, kSteps + 1> change = Changes(*cells);
  const double gain = fine_.Reverberation(at.patch, receiver);
  Rgb sum = irradiance.truth;
  for (std::size_t j = 0; j < kSteps; ++j) irradiance.shown[j] = sum += gain * change[j];
  return irradiance;
}

}  // namespace

SourceCut ChooseSourceCut(const RadiositySolution& solution, const SourceCells& cells,
                          const PointIrradiance& exact, const SourceCutOptions& options,
                          const ExecutionContext& context) {
  SourceCut chosen;
  if (cells.cells().empty() || options.points == 0) return chosen;
  const Scene& scene = solution.forest.scene();
  const std::vector<double> scores = ScoresFrom(options.finest);
  const CutTrial trial(solution, cells, exact, scores);
  const std::vector<SurfacePoint> at =
      SpreadPoints(scene, ReflectingAreas(scene), options.points, options.seed);
  std::vector<Rgb> truth(options.points);
  std::vector<std::vector<Rgb>> shown(kSteps, std::vector<Rgb>(options.points));
  ParallelFor(options.points, kPointGrain, [&](std::size_t p) {
    if (context.Cancelled()) return;
    const CutTrial::Irradiance irradiance = trial.At(at[p]);
    truth[p] = irradiance.truth;
    for (std::size_t j = 0; j < kSteps; ++j) shown[j][p] = irradiance.shown[j];
  });
  for (std::size_t j = 0; j < kSteps && !context.Cancelled(); ++j) {
    const double p99 = Quantile(SeenErrors(scene, at, shown[j], truth), 0.99);
    if (j > 0 && p99 > options.error) break;
    chosen.score = scores[j];
    chosen.p99 = p99;
  }
  return chosen;
}

}  // namespace penumbra
