// solver/transport/links/transport_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// A refinement oracle (AreaWeightedOracle) with deviation(F) = Link::variation, the deviation of the link's
// point form factors over sample points of the receiver.
OracleRegistry::Method TransportOracleMethod();

}  // namespace penumbra
