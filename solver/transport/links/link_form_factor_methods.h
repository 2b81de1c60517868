// solver/transport/links/link_form_factor_methods.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// Every method there is to find form factors of links. The first is the default.
LinkFormFactorRegistry& LinkFormFactorMethods();

}  // namespace penumbra
