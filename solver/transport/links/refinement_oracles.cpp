#include "solver/transport/links/refinement_oracles.h"

#include "solver/transport/links/gradient_oracle.h"
#include "solver/transport/links/thesis_oracle.h"
#include "solver/transport/links/transport_oracle.h"
#include "solver/transport/links/visibility_oracle.h"

namespace penumbra {

OracleRegistry& RefinementOracles() {
  static OracleRegistry registry("refinement oracle", {TransportOracleMethod(), VisibilityOracleMethod(),
                                                       GradientOracleMethod(), ThesisOracleMethod()});
  return registry;
}

}  // namespace penumbra
