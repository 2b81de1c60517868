#include "solver/transport/solvers/uniform_solver.h"

#include <string>

#include "solver/base/check.h"
#include "solver/base/stopwatch.h"

namespace penumbra {
namespace {

RadiositySolution UniformMesh(const Scene& scene, int divisions) {
  RadiositySolution solution;
  solution.forest = UniformForest(scene, divisions);
  return solution;
}

}  // namespace

UniformSolver::UniformSolver(const Scene& scene, const PatchVisibility& visibility,
                             const UniformOptions& options, std::size_t most_steps)
    : scene_(scene),
      visibility_(visibility),
      options_(options),
      solution_(UniformMesh(scene, options.divisions)),
      push_pull_(solution_),
      most_steps_(options.shots > 0 ? options.shots : most_steps) {
  first_leaf_.assign(scene.patches.size() + 1, 0);
  for (const ElementId leaf : leaves())
    ++first_leaf_[static_cast<std::size_t>(solution_.forest[leaf].patch) + 1];
  for (std::size_t p = 0; p < scene.patches.size(); ++p) first_leaf_[p + 1] += first_leaf_[p];
  if (EmittedFlux().maxCoeff() == 0) residual_ = 0;
  if (options.shots > 0) report_.most_iterations = static_cast<int>(options.shots);
  Show(std::vector<Rgb>(leaves().size(), Rgb::Zero()));
}

std::optional<SolverStep> UniformSolver::Next() const {
  if (!ready_ || Converged() || report_.iterations.size() >= most_steps_) return std::nullopt;
  return SolverStep::kIterate;
}

bool UniformSolver::Step(SolverStep step, const ExecutionContext& context) {
  if (step != SolverStep::kIterate || !ready_) return false;
  const Stopwatch stopwatch;
  IterationReport report;
  if (!Advance(&report, context)) return false;
  residual_ = report.residual;
  report.elements = solution_.forest.size();
  report.seconds = stopwatch.Seconds();
  report_.iterations.push_back(report);
  return true;
}

bool UniformSolver::SetLight(std::span<const Rgb>, std::vector<Fragment>, const ExecutionContext&) {
  PENUMBRA_CHECK(TakesLight());
  return false;
}

std::shared_ptr<const LeafVisibility> UniformSolver::SeenFromLeaves(const ExecutionContext& context) {
  return seen_from_leaves_.Get(solution_.forest, visibility_, context);
}

void UniformSolver::Show(std::span<const Rgb> irradiance) {
  const std::span<const ElementId> all = leaves();
  for (std::size_t i = 0; i < all.size(); ++i) push_pull_.Light(all[i], irradiance[i]);
  push_pull_.Pull();
  push_pull_.UpdateSpreads();
}

Rgb UniformSolver::EmittedFlux() const {
  Rgb flux = Rgb::Zero();
  for (const Patch& patch : scene_.patches)
    flux += patch.area * scene_.materials[static_cast<std::size_t>(patch.material)].emittance;
  return flux;
}

}  // namespace penumbra
