// solver/transport/links/size_oracle.h

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// The refinement oracle `size`: splits the larger end of a link whose diameter exceeds a fourth of the
// distance between the centres of both ends. OracleOptions::eps has no effect.
OracleRegistry::Method SizeOracleMethod();

}  // namespace penumbra
