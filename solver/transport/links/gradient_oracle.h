// solver/transport/links/gradient_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// Takes the deviation of the linear function that has the form factor's gradient at the receiver's centre,
// without occlusion; for partial links the sampled deviation if that is larger.
OracleRegistry::Method GradientOracleMethod();

}  // namespace penumbra
