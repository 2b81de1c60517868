// solver/transport/solvers/stochastic_solver.h

#pragma once

#include <cstdint>
#include <vector>

#include "solver/transport/links/element_locator.h"
#include "solver/transport/solvers/uniform_solver.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {

// Monte Carlo radiosity (Neumann et al. 1995; Ashdown 1994, 8.3): stochastic Jacobi iterations. In a bounce,
// the unsent flux of all elements leaves in rays of equal flux, summed over the channels; the element that a
// ray hits reflects what arrives in the next bounce. A step is a bundle of rays that is followed until its
// flux is below the cut-off; the light is the mean of all bundles. Origins and directions are points of
// low-discrepancy sequences, and each element goes on in its own from bundle to bundle. No form factor is
// computed, and nothing else is stored than the light.
class StochasticSolver final : public UniformSolver {
 public:
  StochasticSolver(const Scene& scene, const PatchVisibility& visibility, const UniformOptions& options,
                   const ExecutionContext& context);

  // All bundles that the options ask for are traced.
  bool Converged() const override { return report().iterations.size() >= bundles_; }

 private:
  // A bundle. The residual is the standard error of the bundles' mean, as the area-weighted root mean square
  // over the elements, relative to that of the irradiance; 1 after the first bundle.
  bool Advance(IterationReport* report, const ExecutionContext& context) override;
  std::vector<std::uint32_t> ShareOut(std::span<const Rgb> flux, double rays, std::uint64_t turn) const;
  std::vector<Rgb> Bounce(std::span<const Rgb> flux, double rays, std::vector<std::size_t>* used,
                          const ExecutionContext& context) const;
  double RelativeError() const;

  std::size_t bundles_;
  std::size_t rays_;  // of a bundle's first bounce
  RayCaster caster_;
  ElementLocator locator_;
  std::vector<std::int32_t> place_;  // of each element in leaves()
  std::vector<std::size_t> used_;    // rays of each leaf in all bundles
  std::vector<Rgb> sum_, squares_;   // over the bundles, of the irradiance of each leaf
};

LightSolverRegistry::Method StochasticSolverMethod();

}  // namespace penumbra
