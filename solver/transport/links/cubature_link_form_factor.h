// solver/transport/links/cubature_link_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The default form-factor method, `cubature`: the form factor of a link is the mean of exact point form
// factors at a few points of the receiver (FindByCubature).
LinkFormFactorRegistry::Method CubatureLinkFormFactorMethod();

}  // namespace penumbra
