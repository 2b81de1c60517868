// solver/transport/solvers/progressive_solver.h

#pragma once

#include <memory>

#include "solver/transport/links/link_form_factor_method.h"
#include "solver/transport/solvers/shooting_solver.h"

namespace penumbra {

// Progressive refinement in which whole patches shoot and elements receive: a shot uses the form factors
// between the shooting patch and each element. Form-factor methods that find all targets in one view
// (hemicube) look from the shooting patch, as in Ashdown (1994). All other form-factor methods look from each
// element at the shooting patch.
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
