// solver/transport/solvers/energy.h
//
// The energy balance of a solution: emitted = absorbed + escaped. The emitted, the absorbed and the escaped
// flux are measured independently of each other.

#pragma once

#include <cstdint>

#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// Fluxes, summed over the channels [W].
struct EnergyBalance {
  double emitted = 0;  // flux that all surfaces emit
  // flux absorbed by fronts (from the solution's irradiance) and by the black backs of patches (from rays)
  double absorbed = 0;
  double escaped = 0;             // flux that leaves the scene, measured by rays
  double relative_imbalance = 0;  // |emitted - absorbed - escaped| / emitted; 0 in a dark scene
};

// Casts cosine-distributed low-discrepancy rays from the leaves of the solution and from the parts
// (fragments) of cut leaves. The number of rays of a leaf or part is proportional to its flux. In smooth
// scenes, the finite number of rays causes a relative error of about 1 / (number of rays). The energy balance
// is deterministic for a given seed. If the computation is cancelled (ExecutionContext), the energy balance
// must not be used.
EnergyBalance MeasureEnergy(const RadiositySolution& solution, std::size_t rays = std::size_t{1} << 18,
                            std::uint64_t seed = 1, const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
