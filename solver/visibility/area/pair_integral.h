// solver/visibility/area/pair_integral.h
//
// The integral, over the points of a part of a patch, of the exact form factor of the point to the visible
// part of a source. AreaFormFactor() calls IntegratePair() for each pair of parts that may see each other.

#pragma once

#include <vector>

#include "solver/scene/scene.h"
#include "solver/visibility/area/area_form_factor.h"
#include "solver/visibility/pair/tube_blockers.h"

namespace penumbra {

// Two parts of patches that may see each other; each part is clipped to the front side of the plane of the
// other part.
struct PartPair {
  PatchId receiver = kNoPatch, source = kNoPatch;
  TubeEnds ends;
  // The area of the part that sends the flux, before it is clipped to the receiver's front [m^2].
  double sender_area = 0;
};

// The largest permissible error of a form factor with the value `factor`: max(tolerance * max(factor,
// tolerance), 2e-17), as for AreaFormFactorOptions::tolerance.
double AllowedError(double factor, double tolerance);

// The integral, over the receiver's part, of the form factor of a point to the visible part of the source
// [m^2]. The error of the integral is estimated in the same way as in AreaFormFactor(). The integration is
// adaptive: an integration cell in which the Gauss and the Kronrod rule differ is first cut along the event
// lines that cross it, in descending order of (number of coincident events) * (length), and then halved.
// REQUIRES: `blockers` is sorted in ascending order.
FormFactorEstimate IntegratePair(const Scene& scene, const PartPair& pair, std::vector<PatchId> blockers,
                                 const AreaFormFactorOptions& options);

}  // namespace penumbra
