// solver/transport/links/link_cubature.h
//
// Form factors of links as means of exact point form factors over the receiver (thesis 4.2, method 3),
// occlusion exact.

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// Sets form factor and variation of each link from the points of Cubature() on the receiver's part before the
// source, and the shares of the source's quarters from the same points. Sources that reflect nothing keep
// equal shares: they have one radiosity for good. Sets nothing of use if it was cancelled.
void FindByCubature(ReceiverLinks* links, const ExecutionContext& context);

}  // namespace penumbra
