// solver/transport/form_factors/contour_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The form-factor method `contour`: F = 1 / (2 pi A) * (double integral of ln r along the boundaries of both
// polygons) (Goral, Torrance, Greenberg and Battaile 1984; Ashdown 1994, 5.2). The inner integral along an
// edge has a closed form; a Kronrod rule approximates the outer integral. The error of the outer integral is
// estimated by the difference between the Kronrod rule and its Gauss rule. The contour integral ignores
// blockers. If there are blockers, F is multiplied by the ratio (mean form factor to the visible part of the
// target) / (mean form factor to the whole target) over 16 points of the sender. The error of a form factor
// with blockers includes the difference between the visible fractions of the target that 16 points and 4
// points of the sender give.
LinkFormFactorRegistry::Method ContourFormFactorMethod();

}  // namespace penumbra
