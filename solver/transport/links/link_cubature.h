// solver/transport/links/link_cubature.h
//
// Form factors of links as means of exact visible point form factors over the receiver (thesis 4.2, method
// 3).

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// Sets Link::form_factor, variation, share and source_variation of each link. Samples the point form factor
// at the points of Cubature() on that part of the receiver that lies before the source's plane. For sources
// that reflect nothing, all entries of Link::share stay 1/4, because their radiosity is constant. The values
// are useless if the context is cancelled.
void FindByCubature(ReceiverLinks* links, const ExecutionContext& context);

}  // namespace penumbra
