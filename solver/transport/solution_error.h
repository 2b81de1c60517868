// solver/transport/solution_error.h
//
// How far the solution is from the one that its own leaves would have with exact transport.

#pragma once

#include <cstdint>

#include "solver/transport/point_irradiance.h"
#include "solver/transport/solution.h"

namespace penumbra {

// An estimate of the relative error that the solution's radiosities bring to the irradiance they send out.
//
// At `points` random points (spread evenly over the fronts) the irradiance of the links is compared with the
// exact irradiance from the leaves. The mean difference on each patch, reflected, is what one more bounce
// would add; the bounces after it make that 1 / (1 - rho). Weighted by area and relative to the mean
// radiosity that is reflected. An estimate, not a bound: it knows nothing of errors that average out over a
// patch, nor of the size of the leaves.
double EstimateSolutionError(const RadiositySolution& solution, const PointIrradiance& irradiance,
                             std::size_t points, std::uint64_t seed);

}  // namespace penumbra
