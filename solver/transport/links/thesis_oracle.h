// solver/transport/links/thesis_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// The refinement oracle as printed in the thesis (4.4.1), without a factor for the area of the receiver. If
// (radiosity of the source) * (deviation of the form factor) exceeds the allowed link error eps, the thesis's
// oracle splits the larger element of the link.
OracleRegistry::Method ThesisOracleMethod();

}  // namespace penumbra
