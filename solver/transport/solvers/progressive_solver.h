// solver/transport/solvers/progressive_solver.h

#pragma once

#include <memory>

#include "solver/transport/links/link_form_factor_method.h"
#include "solver/transport/solvers/shooting_solver.h"

namespace penumbra {

// Patches shoot, elements receive: the form factors of a shot are those between the patch as a whole and each
// element. Methods that see all at once look from the patch, as Ashdown's hemicube does; the others look from
// each element at the patch.
class ProgressiveSolver final : public ShootingSolver {
 public:
  ProgressiveSolver(const Scene& scene, const PatchVisibility& visibility, const UniformOptions& options,
                    const ExecutionContext& context);

 private:
  std::vector<double> FormFactorsOf(PatchId shooter, const ExecutionContext& context) const override;
  std::vector<double> FromShooter(PatchId shooter, const ExecutionContext& context) const;
  std::vector<double> FromReceivers(PatchId shooter, const ExecutionContext& context) const;

  std::unique_ptr<const LinkFormFactorMethod> method_;
};

LightSolverRegistry::Method ProgressiveSolverMethod();

}  // namespace penumbra
