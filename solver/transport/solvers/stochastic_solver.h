// solver/transport/solvers/stochastic_solver.h

#pragma once

#include <cstdint>
#include <vector>

#include "solver/transport/links/element_locator.h"
#include "solver/transport/solvers/uniform_solver.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {

// Monte Carlo radiosity (Neumann et al. 1995; Ashdown 1994, 8.3): stochastic Jacobi iterations. In each
// bounce, the unsent flux of all elements leaves along rays of equal flux, summed over the three channels.
// The element that a ray hits reflects the flux of the ray in the next bounce. A step of the solver follows a
// bundle of rays, bounce after bounce, until the remaining flux is below a cut-off. The solution is the mean
// over all bundles of rays. Origins and directions of rays are points of low-discrepancy sequences; each
// element has its own sequence, which continues from bundle to bundle. Stochastic Jacobi iterations compute
// no form factors and store only the light.
class StochasticSolver final : public UniformSolver {
 public:
  StochasticSolver(const Scene& scene, const PatchVisibility& visibility, const UniformOptions& options,
                   const ExecutionContext& context);

  // True if all bundles of rays that the options request have been traced.
  bool Converged() const override { return report().iterations.size() >= bundles_; }

 private:
  // Traces one bundle of rays. The residual is rms(standard error of the mean over the bundles) /
  // rms(irradiance), where rms is the area-weighted root mean square over the elements. After the first
  // bundle, the residual is 1.
  bool Advance(IterationReport* report, const ExecutionContext& context) override;
  std::vector<std::uint32_t> ShareOut(std::span<const Rgb> flux, double rays, std::uint64_t turn) const;
  std::vector<Rgb> Bounce(std::span<const Rgb> flux, double rays, std::vector<std::size_t>* used,
                          const ExecutionContext& context) const;
  double RelativeError() const;

  std::size_t bundles_;
  std::size_t rays_;  // number of rays in the first bounce of a bundle
  RayCaster caster_;
  ElementLocator locator_;
  std::vector<std::int32_t> place_;  // index of each element in leaves()
  std::vector<std::size_t> used_;    // number of rays that each leaf has cast in all bundles
  // For each leaf, the sums over all bundles of rays of the irradiance, and of the squared irradiance.
  std::vector<Rgb> sum_, squares_;
};

LightSolverRegistry::Method StochasticSolverMethod();

}  // namespace penumbra
