// solver/transport/links/exact_link_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The form factor between areas (AreaFormFactor), within LinkFormFactorOptions::tolerance; row sums and
// reciprocity hold to the same tolerance. Variation and shares are those of the cubature.
LinkFormFactorRegistry::Method ExactLinkFormFactorMethod();

}  // namespace penumbra
