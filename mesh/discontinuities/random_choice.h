// mesh/discontinuities/random_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// In random order, as many as a leaf may have, contacts first: to compare with ranking. Of the others it
// tries DiscontinuityOptions::random_share.
DiscontinuityChoiceRegistry::Method RandomChoiceMethod();

}  // namespace penumbra
