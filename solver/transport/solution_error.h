// solver/transport/solution_error.h
//
// How far the solution is from the one that its own leaves would have with exact transport.

#pragma once

#include <cstdint>

#include "solver/transport/point_irradiance.h"
#include "solver/transport/solution.h"

namespace penumbra {

// An estimate of the relative error of the solution's irradiance, root mean square over the fronts, for
// leaves of their size: the exact mean irradiance of the leaves at `points` random points, less the
// solution's, relative to the mean; the bounces that follow make it 1 / (1 - rho) of that. It does not know
// what radiosities that vary within leaves bring.
double EstimateSolutionError(const RadiositySolution& solution, const PointIrradiance& irradiance,
                             std::size_t points, std::uint64_t seed);

}  // namespace penumbra
