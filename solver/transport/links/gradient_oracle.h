// solver/transport/links/gradient_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// A refinement oracle (AreaWeightedOracle) that approximates the form factor over the receiver by a linear
// function. The linear function has the gradient of the unoccluded form factor at the receiver's centre. The
// deviation of a link's form factor over the receiver is that of the linear function; for links with
// blockers, it is max(deviation of the linear function, Link::variation).
OracleRegistry::Method GradientOracleMethod();

}  // namespace penumbra
