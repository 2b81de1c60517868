// solver/transport/form_factors/rays_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The method `rays`: rays to random points of the source, by the unbiased formula (FactorBySourceRays). A
// link takes 64 rays, 16 from each of 4 points, unless the options say otherwise.
LinkFormFactorRegistry::Method RaysFormFactorMethod();

}  // namespace penumbra
