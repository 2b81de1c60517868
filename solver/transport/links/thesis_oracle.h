// solver/transport/links/thesis_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// The oracle as printed in the thesis (4.4.1): compares B * deviation(F) with eps, whatever the area, and
// splits the larger element.
OracleRegistry::Method ThesisOracleMethod();

}  // namespace penumbra
