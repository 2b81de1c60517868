// solver/transport/solvers/energy.h
//
// The energy balance of a solution: emitted = absorbed + escaped. The emitted, the absorbed and the escaped
// energy are measured independently.

#pragma once

#include <cstdint>

#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// Fluxes, summed over the channels [W].
struct EnergyBalance {
  double emitted = 0;             // by the surfaces
  double absorbed = 0;            // by fronts (from the solution's irradiance) and by black backs (from rays)
  double escaped = 0;             // leaves the scene, from rays
  double relative_imbalance = 0;  // |emitted - absorbed - escaped| / emitted; 0 in a dark scene
};

// Casts cosine-distributed low-discrepancy rays from the leaves and fragments; the number of rays of each is
// proportional to its flux. The error caused by the finite number of rays is about 1 / rays in smooth scenes.
// The result is deterministic for a given seed. The result is useless if the context is cancelled.
EnergyBalance MeasureEnergy(const RadiositySolution& solution, std::size_t rays = std::size_t{1} << 18,
                            std::uint64_t seed = 1, const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
