// solver/transport/solvers/shooting_solver.h
//
// Progressive refinement: in each step, the patch with the largest unsent flux shoots this flux to the
// elements of all other patches (Cohen, Chen, Wallace and Greenberg 1988; Ashdown 1994, 6.3 to 6.8).
// Progressive refinement is Southwell's relaxation, whose residual is the unsent light.

#pragma once

#include <map>
#include <vector>

#include "solver/transport/solvers/uniform_solver.h"

namespace penumbra {

class ShootingSolver : public UniformSolver {
 public:
  // The flux balance after the shots so far [W]. In a closed room, emitted flux = absorbed flux + unsent flux
  // after every shot, if the form factors obey reciprocity and add up to 1.
  struct Ledger {
    Rgb emitted = Rgb::Zero(), absorbed = Rgb::Zero(), unsent = Rgb::Zero();
  };
  Ledger Balance() const;

  // The ambient term: an estimate of the irradiance that all unsent light will bring, spread evenly over all
  // surfaces (Ashdown 1994, eq. 6.35 to 6.37) [W/m^2].
  Rgb AmbientIrradiance() const;

 protected:
  ShootingSolver(const Scene& scene, const PatchVisibility& visibility, const UniformOptions& options);

  // For each leaf, in the order of leaves(), the mean irradiance per unit radiosity of the shooting patch. If
  // the computation is cancelled (ExecutionContext), the form factors must not be used.
  virtual std::vector<double> FormFactorsOf(PatchId shooter, const ExecutionContext& context) const = 0;

  // Makes one shot of progressive refinement. The residual of progressive refinement is (sum of |unsent
  // flux|) / (emitted flux).
  bool Advance(IterationReport* report, const ExecutionContext& context) final;

 private:
  const std::vector<double>& RowOf(PatchId shooter, const ExecutionContext& context);
  PatchId Brightest() const;
  Rgb Overshoot(PatchId shooter, std::span<const double> row) const;

  std::vector<Rgb> irradiance_;  // irradiance of each leaf from all shots [W/m^2]
  std::vector<Rgb> unsent_;      // radiosity that each patch has not yet shot to other patches [W/m^2]
  // Cached form factors from patches that have shot light to all leaves, up to a limit of memory.
  std::map<PatchId, std::vector<double>> rows_;
};

}  // namespace penumbra
