// solver/transport/links/refinement_oracles.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// Every refinement oracle there is. The first is the default.
OracleRegistry& RefinementOracles();

}  // namespace penumbra
