// solver/transport/links/gradient_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// An AreaWeightedOracle that approximates the form factor over the receiver by a linear function, which has
// the gradient of the unoccluded form factor at the receiver's centre. The deviation of a link is the
// deviation of the linear function; for links with blockers, it is max(deviation of the linear function,
// Link::variation).
OracleRegistry::Method GradientOracleMethod();

}  // namespace penumbra
