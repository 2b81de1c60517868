// solver/transport/solvers/dense_solver.h
//
// Solves dense systems directly, for all three channels: reference solutions.

#pragma once

#include <span>
#include <vector>

#include "solver/transport/links/solution.h"
#include "solver/transport/solvers/dense_system.h"

namespace penumbra {

// The light of a dense system's unknowns.
struct DenseLight {
  std::vector<Rgb> irradiance, radiosity;  // per unknown [W/m^2]
};

// B = E + rho T B by LU factors with pivots. `emittance` [W/m^2] and `reflectance` are per unknown; those of
// the scene's materials by default.
DenseLight SolveDense(const DenseSystem& system);
DenseLight SolveDense(const DenseSystem& system, std::span<const Rgb> emittance,
                      std::span<const Rgb> reflectance);

// The irradiance at a point on the front of a patch from the solution as it is, linear or quadratic over each
// element [W/m^2]. Exact past whatever blocks, but for kSourceQuadratureError. Safe from any thread.
Rgb DenseIrradiance(const DenseSystem& system, const DenseLight& light, const PatchVisibility& visibility,
                    PatchId patch, const ReceiverPoint& at);

// The solution as exact probes and meshes take it: each leaf has the mean of its radiosity. No links.
RadiositySolution ToRadiositySolution(const DenseSystem& system, const DenseLight& light);

}  // namespace penumbra
