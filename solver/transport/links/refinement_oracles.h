// solver/transport/links/refinement_oracles.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// All refinement oracles; the first is the default.
OracleRegistry& RefinementOracles();

}  // namespace penumbra
