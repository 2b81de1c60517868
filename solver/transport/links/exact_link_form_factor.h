// solver/transport/links/exact_link_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The most accurate form-factor method, `exact`: the form factor between two areas (AreaFormFactor), with an
// error of at most LinkFormFactorOptions::tolerance. Row sums and reciprocity of the exact form factors hold
// to LinkFormFactorOptions::tolerance. Link::variation and Link::share are computed by FindByCubature().
LinkFormFactorRegistry::Method ExactLinkFormFactorMethod();

}  // namespace penumbra
