// solver/transport/links/cubature_link_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The mean over a few points of the receiver (FindByCubature).
LinkFormFactorRegistry::Method CubatureLinkFormFactorMethod();

}  // namespace penumbra
