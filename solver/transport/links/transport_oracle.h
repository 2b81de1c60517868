// solver/transport/links/transport_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// Takes the deviation among the points at which the link was sampled.
OracleRegistry::Method TransportOracleMethod();

}  // namespace penumbra
