// solver/transport/form_factors/book_rays_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The form-factor method `rays-book` casts n rays from a point to random points of an area A. Each of the n
// rays to the area A stands for a disk of area A / n and adds (A / n) cos cos / (pi r^2 + A / n) to the form
// factor (Wallace, Elmquist and Haines 1989; Ashdown 1994, eq. 5.46). The sum of the disk formula (A / n) cos
// cos / (pi r^2 + A / n) over the rays never exceeds 1 at small distances r, but is too small on average. For
// n = 16 rays to a square at a distance of one side of the square, the disk formula is 1.7 % too small. The
// stated error of a form factor includes the difference between the disk formula and the unbiased formula
// (RayFormula::kUnbiased).
LinkFormFactorRegistry::Method BookRaysFormFactorMethod();

}  // namespace penumbra
