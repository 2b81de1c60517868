// solver/transport/form_factors/monte_carlo_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The method `monte-carlo`: the double integral over both areas, at pairs of random points: F = (area of the
// target) * mean of V cos cos / (pi r^2). A link takes 256 pairs of points unless the options say otherwise.
// The error is the standard error. Where areas touch, the values have no finite variance: the mean still
// converges, but slower than 1 / sqrt(n), and now and then by more than the error says.
LinkFormFactorRegistry::Method MonteCarloFormFactorMethod();

}  // namespace penumbra
