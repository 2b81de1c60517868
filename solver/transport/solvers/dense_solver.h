// solver/transport/solvers/dense_solver.h
//
// Solves dense systems directly, for all three channels: reference solutions. DenseSolver is the solver of
// that kind.

#pragma once

#include <span>
#include <vector>

#include "solver/transport/links/solution.h"
#include "solver/transport/solvers/dense_system.h"
#include "solver/transport/solvers/light_solver.h"

namespace penumbra {

// The light of a dense system's unknowns.
struct DenseLight {
  std::vector<Rgb> irradiance, radiosity;  // per unknown [W/m^2]
};

// B = E + rho T B by LU factors with pivots. `emittance` [W/m^2] and `reflectance` are per unknown; those of
// the scene's materials by default.
DenseLight SolveDense(const DenseSystem& system);
DenseLight SolveDense(const DenseSystem& system, std::span<const Rgb> emittance,
                      std::span<const Rgb> reflectance);

// The irradiance at a point on the front of a patch from the solution as it is, linear or quadratic over each
// element [W/m^2]. Exact past whatever blocks, but for kSourceQuadratureError. Safe from any thread.
Rgb DenseIrradiance(const DenseSystem& system, const DenseLight& light, const PatchVisibility& visibility,
                    PatchId patch, const ReceiverPoint& at);

// The solution as exact probes and meshes take it: each leaf has the mean of its radiosity. No links.
RadiositySolution ToRadiositySolution(const DenseSystem& system, const DenseLight& light);

// Unknowns that a dense solve may have: 4 GB with the copy that is factored.
inline constexpr std::size_t kMostDenseUnknowns = 16'000;

// The dense system of a uniform mesh, solved directly as it is made: there are no steps left. Linear and
// quadratic elements hand on their means. The light stays as it was solved, whatever is shown of it.
class DenseSolver final : public LightSolver {
 public:
  // Throws InputError if the system has more than kMostDenseUnknowns. Cancelled, it leaves the roots, dark
  // but for what they emit.
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
  double PartOfTolerance() const override { return 1; }
  std::shared_ptr<const LeafVisibility> SeenFromLeaves(const ExecutionContext& context) override;
  std::vector<Rgb> MeanIrradianceByBounce(int) const override { return {}; }

 private:
  const PatchVisibility& visibility_;
  bool solved_ = false;
  RadiositySolution solution_;
  SolverReport report_;
  std::shared_ptr<const LeafVisibility> seen_from_leaves_;
};

LightSolverRegistry::Method DenseSolverMethod();

}  // namespace penumbra
