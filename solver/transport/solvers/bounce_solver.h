// solver/transport/solvers/bounce_solver.h

#pragma once

#include <vector>

#include "solver/transport/solvers/uniform_solver.h"

namespace penumbra {

// Gathers bounce after bounce on a uniform mesh, and computes the form factors anew in each step. After n
// steps, the light that was reflected n times or more is missing.
class BounceSolver final : public UniformSolver {
 public:
  BounceSolver(const Scene& scene, const PatchVisibility& visibility, const UniformOptions& options,
               const ExecutionContext& context);

 private:
  bool Advance(IterationReport* report, const ExecutionContext& context) override;

  std::vector<Rgb> radiosity_;  // of each element, by element index [W/m^2]
};

LightSolverRegistry::Method BounceSolverMethod();

}  // namespace penumbra
