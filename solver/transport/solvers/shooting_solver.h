// solver/transport/solvers/shooting_solver.h
//
// Progressive refinement: patch after patch sends the light that it has not sent yet to the elements of all
// others, the one with the largest flux first (Cohen, Chen, Wallace and Greenberg 1988; Ashdown 1994, 6.3 to
// 6.8). Progressive refinement is Southwell's relaxation; what is left to send is its residual.

#pragma once

#include <map>
#include <vector>

#include "solver/transport/solvers/uniform_solver.h"

namespace penumbra {

class ShootingSolver : public UniformSolver {
 public:
  // Fluxes of the present state [W]. In a closed room, emitted = absorbed + unsent after every shot, if the
  // form factors obey reciprocity and add up to 1.
  struct Ledger {
    Rgb emitted = Rgb::Zero(), absorbed = Rgb::Zero(), unsent = Rgb::Zero();
  };
  Ledger Balance() const;

  // The estimate of the irradiance that all unsent light will bring, spread evenly (Ashdown 1994, eq. 6.35 to
  // 6.37) [W/m^2].
  Rgb AmbientIrradiance() const;

 protected:
  ShootingSolver(const Scene& scene, const PatchVisibility& visibility, const UniformOptions& options);

  // The mean irradiance of each leaf per unit radiosity of the patch, in the order of leaves(). Useless if
  // the context is cancelled.
  virtual std::vector<double> FormFactorsOf(PatchId shooter, const ExecutionContext& context) const = 0;

  // A shot. The residual is (sum of |unsent flux|) / (emitted flux).
  bool Advance(IterationReport* report, const ExecutionContext& context) final;

 private:
  const std::vector<double>& RowOf(PatchId shooter, const ExecutionContext& context);
  PatchId Brightest() const;
  Rgb Overshoot(PatchId shooter, std::span<const double> row) const;

  std::vector<Rgb> irradiance_;                  // of each leaf, from all shots [W/m^2]
  std::vector<Rgb> unsent_;                      // of each patch: radiosity that is still to be sent [W/m^2]
  std::map<PatchId, std::vector<double>> rows_;  // of patches that have shot, while there is room
};

}  // namespace penumbra
