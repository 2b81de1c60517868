// solver/transport/links/visibility_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// A refinement oracle like that of TransportOracleMethod(), but with twice the deviation of the form factor
// for links with blockers, because shadows may fall between the sample points.
OracleRegistry::Method VisibilityOracleMethod();

}  // namespace penumbra
