// mesh/discontinuities/random_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Chooses in random order, as many discontinuities as a leaf has room for, contacts first: a baseline for the
// ranked choice. Apart from contacts, the choice tries the fraction DiscontinuityOptions::random_share.
DiscontinuityChoiceRegistry::Method RandomChoiceMethod();

}  // namespace penumbra
