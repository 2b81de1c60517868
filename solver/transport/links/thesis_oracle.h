// solver/transport/links/thesis_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// The oracle as printed in the thesis (4.4.1): compares B * deviation(F) with eps, without an area factor,
// and splits the larger element of the link.
OracleRegistry::Method ThesisOracleMethod();

}  // namespace penumbra
