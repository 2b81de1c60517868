// solver/transport/solvers/energy.h
//
// Where the light goes: emitted = absorbed + escaped, each part measured on its own.

#pragma once

#include <cstdint>

#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// Fluxes [W], summed over the channels.
struct EnergyBalance {
  double emitted = 0;             // what the surfaces emit
  double absorbed = 0;            // by fronts, from the solution's irradiance, and by black backs, by rays
  double escaped = 0;             // what leaves the scene, by rays
  double relative_imbalance = 0;  // |emitted - absorbed - escaped| / emitted; 0 in a dark scene
};

// Rays leave the leaves and fragments by a low-discrepancy rule, as many from each as its share of the flux,
// cosine distributed. Their error is about 1 / rays for smooth scenes. Deterministic for a given seed. Of no
// use if it was cancelled.
EnergyBalance MeasureEnergy(const RadiositySolution& solution, std::size_t rays = std::size_t{1} << 18,
                            std::uint64_t seed = 1, const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
