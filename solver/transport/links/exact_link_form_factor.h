// solver/transport/links/exact_link_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// Between areas (AreaFormFactor), to LinkFormFactorOptions::tolerance: sums and reciprocity hold to that.
// Variation and shares are those of the cubature.
LinkFormFactorRegistry::Method ExactLinkFormFactorMethod();

}  // namespace penumbra
