// solver/transport/links/thesis_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// The refinement oracle as printed in the thesis (4.4.1) compares B * deviation(F) with eps, without an area
// factor; B is the source's radiosity and F the form factor. If (radiosity of the source) * (deviation of the
// form factor) exceeds eps, the thesis's oracle splits the larger element of the link.
OracleRegistry::Method ThesisOracleMethod();

}  // namespace penumbra
