// solver/transport/solvers/dense_solver.h
//
// Direct solution of the dense radiosity system for all three channels, to compute reference solutions.
// DenseSolver implements the solver interface LightSolver by a direct solution of the dense radiosity system.

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/transport/links/solution.h"
#include "solver/transport/solvers/dense_system.h"
#include "solver/transport/solvers/light_solver.h"

namespace penumbra {

// The light of the unknowns of a dense radiosity system.
struct DenseLight {
  std::vector<Rgb> irradiance, radiosity;  // irradiance and radiosity of each unknown [W/m^2]
};

// Solves B = E + rho T B for the radiosities B by LU factorisation with pivoting. `emittance` [W/m^2] and
// `reflectance` have one entry for each unknown; by default, the entries come from the scene's materials.
DenseLight SolveDense(const DenseSystem& system);
// SolveDense() with a scene takes the emittance and reflectance of that scene's materials; the scene must
// have the same patches as the system.
DenseLight SolveDense(const DenseSystem& system, const Scene& scene);
DenseLight SolveDense(const DenseSystem& system, std::span<const Rgb> emittance,
                      std::span<const Rgb> reflectance);

// The irradiance at a point on the front of a patch [W/m^2], from a radiosity that is constant, linear or
// quadratic over each element. Visibility is exact; the integration over the sources has an error of at most
// kSourceQuadratureError. Any thread may call DenseIrradiance().
Rgb DenseIrradiance(const DenseSystem& system, const DenseLight& light, const PatchVisibility& visibility,
                    PatchId patch, const ReceiverPoint& at);

// Converts the dense solution to a RadiositySolution, which irradiance probes and meshes need: each leaf of
// the quadtrees gets its mean radiosity. The converted RadiositySolution has no links between elements.
RadiositySolution ToRadiositySolution(const DenseSystem& system, const DenseLight& light);

// The largest number of unknowns of a dense system. For kMostDenseUnknowns unknowns, the matrix and the copy
// that is factorised need 4 GB of memory.
inline constexpr std::size_t kMostDenseUnknowns = 16'000;

// The constructor of DenseSolver solves the dense system of a uniform mesh completely, so that the solver
// makes no iterations. Meshing and display see only the mean radiosity of linear and quadratic elements.
// LitAs(), which makes a solver for other emittances, needs DenseOptions::keep_matrix.
class DenseSolver final : public LightSolver {
 public:
  // Throws InputError if the system has more than kMostDenseUnknowns unknowns. If the computation is
  // cancelled (ExecutionContext), the solution consists only of the root elements, whose radiosity is their
  // emittance.
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
  // the system of the scene for which the matrix was assembled; null unless keep_matrix is true
  std::shared_ptr<const DenseSystem> system_;
  bool solved_ = false;
  RadiositySolution solution_;
  SolverReport report_;
  LeafVisibilityCache seen_from_leaves_;
};

LightSolverRegistry::Method DenseSolverMethod();

}  // namespace penumbra
