// solver/transport/links/refinement_oracles.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// The registry of all refinement oracles; the first oracle in the registry is the default.
OracleRegistry& RefinementOracles();

}  // namespace penumbra
