// solver/transport/form_factors/link_form_factor_methods.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The registry of all methods that compute form factors, for links between elements and for pairs of areas.
// The first method in the registry is the default.
LinkFormFactorRegistry& LinkFormFactorMethods();

}  // namespace penumbra
