// solver/transport/form_factors/rays_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The form-factor method `rays` casts rays to random points of the source and uses the unbiased formula
// (RayFormula::kUnbiased). By default, the form factor of a link takes 64 rays, 16 from each of 4 points.
LinkFormFactorRegistry::Method RaysFormFactorMethod();

}  // namespace penumbra
