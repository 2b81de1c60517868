// solver/transport/links/link_cubature.h
//
// The form factor of a link as the mean, over points of the receiver, of exact form factors to the visible
// part of the source (thesis 4.2, method 3).

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// Sets Link::form_factor, variation, share and source_variation of each link. Samples the point form factor
// at the points of Cubature() on that part of the receiver that lies in front of the source's plane.
// Link::share, the fractions of the form factor that the source's quarters contribute, stays 1/4 for sources
// that reflect nothing, because the radiosity of such a source is constant. If the computation is cancelled
// (ExecutionContext), the links' values must not be used. `occlusion` finds the visible parts of sources;
// null stands for the fastest exact method.
void FindByCubature(ReceiverLinks* links, const ExecutionContext& context,
                    const OcclusionMethod* occlusion = nullptr);

}  // namespace penumbra
