// solver/transport/links/visibility_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// The transport oracle with twice the deviation for partial links, because shadows may fall between the
// sampled points.
OracleRegistry::Method VisibilityOracleMethod();

}  // namespace penumbra
