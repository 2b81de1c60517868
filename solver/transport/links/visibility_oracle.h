// solver/transport/links/visibility_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// Like the oracle of TransportOracleMethod(), but with twice the deviation for links with blockers, because
// shadows may fall between the sample points.
OracleRegistry::Method VisibilityOracleMethod();

}  // namespace penumbra
