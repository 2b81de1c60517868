// solver/visibility/area/pair_integral.h
//
// The integral of the exact visible form factor of a point over a part of a patch. AreaFormFactor() computes
// the integral for each pair of parts that may see each other.

#pragma once

#include <vector>

#include "solver/scene/scene.h"
#include "solver/visibility/area/area_form_factor.h"
#include "solver/visibility/pair/tube_blockers.h"

namespace penumbra {

// Two parts that may see each other; each is clipped to the front of the other's plane.
struct PartPair {
  PatchId receiver = kNoPatch, source = kNoPatch;
  TubeEnds ends;
  double sender_area = 0;  // of the unclipped part that sends the flux [m^2]
};

// The largest permissible error of a form factor with the value `factor`: max(tolerance * max(factor,
// tolerance), 2e-17), as for AreaFormFactorOptions::tolerance.
double AllowedError(double factor, double tolerance);

// The integral of the visible form factor over the tube's receiver [m^2]. The error is estimated as in
// AreaFormFactor(). The integration is adaptive: where the Gauss and the Kronrod rule differ, cells are cut
// along the event lines that cross them, those of the largest weight first, and then halved. REQUIRES:
// `blockers` is sorted in ascending order.
FormFactorEstimate IntegratePair(const Scene& scene, const PartPair& pair, std::vector<PatchId> blockers,
                                 const AreaFormFactorOptions& options);

}  // namespace penumbra
