// solver/transport/form_factors/monte_carlo_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The form-factor method `monte-carlo` integrates over both areas at random pairs of points: F = (area of the
// target) * mean of V cos cos / (pi r^2). By default, the method `monte-carlo` takes 256 pairs of points for
// the form factor of a link. The error of the form factor is the standard error of the mean. If the two areas
// touch, the samples have no finite variance: the mean converges more slowly than 1 / sqrt(n), and the true
// error occasionally exceeds the stated error.
LinkFormFactorRegistry::Method MonteCarloFormFactorMethod();

}  // namespace penumbra
