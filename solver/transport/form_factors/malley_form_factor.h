// solver/transport/form_factors/malley_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The form-factor method `malley`: F = (rays that hit the target) / (all rays). The rays leave random points
// of the sender in cosine-distributed directions: each direction is a random point of the unit disk,
// projected up to the hemisphere (Malley 1988; Ashdown 1994, 5.22). A sender casts the same rays for all
// targets, so that its form factors to all surfaces of a closed room add up to 1. By default, the method
// `malley` casts 4096 rays for the form factor of a link. The error of the form factor is the standard error
// of the hit rate.
LinkFormFactorRegistry::Method MalleyFormFactorMethod();

}  // namespace penumbra
