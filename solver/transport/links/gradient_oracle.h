// solver/transport/links/gradient_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// The deviation is that of a linear function with the gradient of the unoccluded form factor at the
// receiver's centre; for partial links, the sampled deviation if that is larger.
OracleRegistry::Method GradientOracleMethod();

}  // namespace penumbra
