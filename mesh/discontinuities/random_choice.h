// mesh/discontinuities/random_choice.h

#pragma once

#include "mesh/discontinuities/discontinuity_choice.h"

namespace penumbra {

// Chooses first the contacts with other surfaces, then other discontinuities in random order, up to the
// largest number of lines in a quadtree leaf. The random choice is a baseline for comparison with
// RankedChoiceMethod(). Of the discontinuities that are no contacts with other surfaces, only the fraction
// DiscontinuityOptions::random_share may become edges.
DiscontinuityChoiceRegistry::Method RandomChoiceMethod();

}  // namespace penumbra
