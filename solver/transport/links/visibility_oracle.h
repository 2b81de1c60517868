// solver/transport/links/visibility_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// As the transport oracle, but the deviation of a partial link counts twice: shadows may fall between the
// points that were sampled.
OracleRegistry::Method VisibilityOracleMethod();

}  // namespace penumbra
