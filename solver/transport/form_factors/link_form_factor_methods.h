// solver/transport/form_factors/link_form_factor_methods.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// All methods to compute form factors, of links and between areas; the first is the default.
LinkFormFactorRegistry& LinkFormFactorMethods();

}  // namespace penumbra
