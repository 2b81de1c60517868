#include "mesh/refinement/emitter_sources.h"

#include <limits>
#include <memory>
#include <utility>

#include "mesh/interpolants/row_sampler.h"
#include "solver/base/check.h"
#include "solver/scene/emitters.h"

namespace penumbra {
namespace {

// The turns end when the light changes by little, after kMostTurns, or when a turn leaves more than
// kStillTurn of the change before it. The limits are those of the whole light (ShownMesh); most rooms need
// three turns.
constexpr int kMostTurns = 40, kFewestTurns = 3;
constexpr double kStillTurn = 0.95;

// One emitter's scene, and a solver that it lights.
struct Lit {
  std::unique_ptr<const Scene> scene;
  std::unique_ptr<LightSolver> solver;  // null if cancelled
};

Lit LitBy(const LightSolver& whole, std::span<const PatchId> emitter, const ExecutionContext& context) {
  Lit lit;
  lit.scene = std::make_unique<const Scene>(LitOnlyBy(whole.solution().forest.scene(), emitter));
  lit.solver = whole.LitAs(*lit.scene, context);
  return lit;
}

EmitterLight LightOf(const LightSolver& solver, std::span<const PatchId> emitter) {
  EmitterLight light;
  light.patches.assign(emitter.begin(), emitter.end());
  light.element = solver.solution().irradiance;
  for (const Fragment& fragment : solver.solution().fragments) light.fragment.push_back(fragment.irradiance);
  return light;
}

// The sources of the whole light, with spreads that hold for the light of each emitter. Nothing if cancelled.
std::optional<SourceSet> SourcesOfAll(const LightSolver& whole,
                                      std::span<const std::vector<PatchId>> emitters,
                                      const ExecutionContext& context) {
  SourceSet sources = SourceSet::ForAnyLight(whole.solution());
  for (const std::vector<PatchId>& emitter : emitters) {
    const Lit lit = LitBy(whole, emitter, context);
    if (!lit.solver) return std::nullopt;
    sources.TakeSpreads(sources.WithLight(SourceLight(lit.solver->solution()).View()));
  }
  return sources;
}

// Gives the sources the means of the interpolants, and lets the links carry the difference, until the light
// stands still. False if cancelled.
bool TakeTurns(LightSolver& solver, const SourceMesh& mesh, const RowSampler& rows,
               const ExecutionContext& context) {
  const Scene& scene = solver.solution().forest.scene();
  double before = std::numeric_limits<double>::infinity();
  for (int turn = 1; turn <= kMostTurns; ++turn) {
    const SourceSet light = rows.exact().sources().WithLight(SourceLight(solver.solution()).View());
    const BuiltMesh shown =
        BuildIrradianceMesh(scene, mesh.triangulations, mesh.how, rows.For(light), context);
    if (context.Cancelled()) return false;
    const SourceCells cells(solver.solution(), {mesh.forest, mesh.triangulations, shown.mesh}, rows.exact(),
                            {std::numeric_limits<double>::infinity(), mesh.cells}, context);
    if (context.Cancelled()) return false;
    const double change = cells.Change();
    if (!solver.SetLight(cells.LeafIrradiance(), cells.Fragments(/*whole_leaves=*/false), context))
      return false;
    if (change <= mesh.settled || (turn > kFewestTurns && change > kStillTurn * before)) break;
    before = change;
  }
  return true;
}

}  // namespace

std::optional<std::vector<EmitterLight>> SolveByEmitter(const LightSolver& whole,
                                                        std::span<const std::vector<PatchId>> emitters,
                                                        const SourceMesh* mesh,
                                                        const ExecutionContext& context) {
  std::optional<PointIrradiance> exact;
  if (mesh) {
    std::optional<SourceSet> sources = SourcesOfAll(whole, emitters, context);
    if (!sources) return std::nullopt;
    exact.emplace(mesh->exact.WithSources(std::move(*sources)));
    mesh->samples.Relight(mesh->samples_from, *exact, mesh->tolerance, context);
    mesh->samples_from = exact->sources();
  }
  std::vector<EmitterLight> lights;
  for (const std::vector<PatchId>& emitter : emitters) {
    context.Report("emitters", static_cast<double>(lights.size()) / static_cast<double>(emitters.size()));
    const Lit lit = LitBy(whole, emitter, context);
    if (!lit.solver) return std::nullopt;
    if (mesh) {
      const RowSampler rows(*exact, mesh->tolerance, &mesh->samples, /*keep=*/true);
      if (!TakeTurns(*lit.solver, *mesh, rows, context)) return std::nullopt;
    }
    lights.push_back(LightOf(*lit.solver, emitter));
    PENUMBRA_CHECK(lights.back().fragment.size() == whole.solution().fragments.size());
  }
  return lights;
}

}  // namespace penumbra
