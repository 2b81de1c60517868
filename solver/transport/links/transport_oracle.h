// solver/transport/links/transport_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// Uses the deviation between the points at which the link was sampled.
OracleRegistry::Method TransportOracleMethod();

}  // namespace penumbra
