// solver/visibility/area/pair_integral.h
//
// The exact visible form factor of a point, integrated over a part of a patch: the work of AreaFormFactor()
// for one pair of parts that may see each other.

#pragma once

#include <vector>

#include "solver/scene/scene.h"
#include "solver/visibility/area/area_form_factor.h"
#include "solver/visibility/pair/tube_blockers.h"

namespace penumbra {

// Two parts that may see each other, clipped to each other.
struct PartPair {
  PatchId receiver = kNoPatch, source = kNoPatch;
  TubeEnds ends;
  double sender_area = 0;  // of the part that sends the flux, unclipped [m^2]
};

// How far off a factor may be for this tolerance (AreaFormFactorOptions::tolerance).
double AllowedError(double factor, double tolerance);

// The integral over the tube's receiver of the form factor to its source past the blockers, which ascend
// [m^2], with an error as in AreaFormFactor(). Adaptive: cells are cut along the event lines that cross them,
// the heaviest first, and then halved, where the difference of two rules says so.
FormFactorEstimate IntegratePair(const Scene& scene, const PartPair& pair, std::vector<PatchId> blockers,
                                 const AreaFormFactorOptions& options);

}  // namespace penumbra
