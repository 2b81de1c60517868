#include "mesh/discontinuities/mesh_options.h"

#include "mesh/discontinuities/discontinuity_choices.h"

namespace penumbra {

bool DiscontinuityOptions::enabled() const { return DiscontinuityChoices().Make(choice)->TakesAny(); }

bool DiscontinuityOptions::ranks_by_error() const {
  return weight == DiscontinuityWeight::kIrradiance && DiscontinuityChoices().Make(choice)->ByWeightAlone();
}

}  // namespace penumbra
