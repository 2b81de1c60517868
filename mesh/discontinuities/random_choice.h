// mesh/discontinuities/random_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Chooses first the contacts, then other discontinuities in random order, until leaves have no more room: a
// baseline with which RankedChoiceMethod() is compared. Of the discontinuities that are no contacts, only the
// fraction DiscontinuityOptions::random_share is considered.
DiscontinuityChoiceRegistry::Method RandomChoiceMethod();

}  // namespace penumbra
