// solver/transport/links/transport_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// An AreaWeightedOracle with deviation(F) = Link::variation, the deviation of the point form factors at the
// points where the link was sampled.
OracleRegistry::Method TransportOracleMethod();

}  // namespace penumbra
