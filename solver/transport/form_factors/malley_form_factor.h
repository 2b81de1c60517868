// solver/transport/form_factors/malley_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The method `malley`: F = hits / rays, for rays that leave the sender at random points in cosine-distributed
// directions, as points of a disk lifted to the hemisphere above (Malley 1988; Ashdown 1994, 5.22). The rays
// of a sender are the same for all targets, so that the form factors to all that it sees in a closed room add
// up to 1. A link takes 4096 rays unless the options say otherwise. The error is the standard error.
LinkFormFactorRegistry::Method MalleyFormFactorMethod();

}  // namespace penumbra
