// solver/transport/solvers/dense_solver.h
//
// Direct solution of dense systems for all three channels, to compute reference solutions. DenseSolver
// implements the interface LightSolver with a dense system.

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/transport/links/solution.h"
#include "solver/transport/solvers/dense_system.h"
#include "solver/transport/solvers/light_solver.h"

namespace penumbra {

// The light of the unknowns of a dense system.
struct DenseLight {
  std::vector<Rgb> irradiance, radiosity;  // per unknown [W/m^2]
};

// Solves B = E + rho T B by LU factorisation with pivoting. `emittance` [W/m^2] and `reflectance` have one
// entry for each unknown; by default, they are taken from the scene's materials.
DenseLight SolveDense(const DenseSystem& system);
// With the materials of another scene of the same patches.
DenseLight SolveDense(const DenseSystem& system, const Scene& scene);
DenseLight SolveDense(const DenseSystem& system, std::span<const Rgb> emittance,
                      std::span<const Rgb> reflectance);

// The irradiance at a point on the front of a patch [W/m^2], from the solution, which is constant, linear or
// quadratic over each element. Visibility is exact; the only error of the integration is
// kSourceQuadratureError. May be called from any thread.
Rgb DenseIrradiance(const DenseSystem& system, const DenseLight& light, const PatchVisibility& visibility,
                    PatchId patch, const ReceiverPoint& at);

// Converts the solution to the form that exact probes and meshes need: each leaf has its mean radiosity. The
// result has no links.
RadiositySolution ToRadiositySolution(const DenseSystem& system, const DenseLight& light);

// The largest number of unknowns. For kMostDenseUnknowns unknowns, the matrix and the copy that is factorised
// need 4 GB of memory.
inline constexpr std::size_t kMostDenseUnknowns = 16'000;

// Solves the dense system of a uniform mesh in its constructor; no steps remain. Other stages see only the
// mean radiosity of linear and quadratic elements. LitAs() needs DenseOptions::keep_matrix.
class DenseSolver final : public LightSolver {
 public:
  // Throws InputError if the system has more than kMostDenseUnknowns unknowns. If the context is cancelled,
  // the solution consists only of the root elements, whose radiosity is their emittance.
  DenseSolver(const Scene& scene, const PatchVisibility& visibility, const DenseOptions& options,
              const ExecutionContext& context);

  bool Ready() const override { return solved_; }
  std::optional<SolverStep> Next() const override { return std::nullopt; }
  bool Step(SolverStep, const ExecutionContext&) override { return false; }
  bool Converged() const override { return solved_; }
  const RadiositySolution& solution() const override { return solution_; }
  const SolverReport& report() const override { return report_; }
  bool Relight(const ExecutionContext&) override { return false; }
  bool TakesLight() const override { return false; }
  bool SetLight(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                const ExecutionContext& context) override;
  std::unique_ptr<LightSolver> LitAs(const Scene& other, const ExecutionContext& context) const override;
  void ReplaceLight(std::span<const Rgb> element, std::span<const Rgb> fragment) override;
  double PartOfTolerance() const override { return 1; }
  std::shared_ptr<const LeafVisibility> SeenFromLeaves(const ExecutionContext& context) override;
  std::vector<Rgb> MeanIrradianceByBounce(int) const override { return {}; }

 private:
  DenseSolver(const DenseSolver& from, const Scene& other);

  const PatchVisibility& visibility_;
  std::shared_ptr<const DenseSystem> system_;  // of the scene for which it was assembled; null unless kept
  bool solved_ = false;
  RadiositySolution solution_;
  SolverReport report_;
  LeafVisibilityCache seen_from_leaves_;
};

LightSolverRegistry::Method DenseSolverMethod();

}  // namespace penumbra
