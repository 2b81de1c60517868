// solver/transport/form_factors/contour_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The method `contour`: the double integral of ln r along both boundaries, 1 / (2 pi A) times it (Goral,
// Torrance, Greenberg and Battaile 1984; Ashdown 1994, 5.2). The inner integral along an edge has a closed
// form, the outer one is a Kronrod rule; its error is the difference from the Gauss rule. Stokes' theorem
// knows no blockers: past blockers, the value is multiplied by (visible part) / (whole) of the point form
// factors at a few points of the sender, and the error includes the change of this ratio from 4 points to 16.
LinkFormFactorRegistry::Method ContourFormFactorMethod();

}  // namespace penumbra
