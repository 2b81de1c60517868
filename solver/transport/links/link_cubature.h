// solver/transport/links/link_cubature.h
//
// Form factors of links as means of exact visible point form factors over the receiver (thesis 4.2, method
// 3).

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// Sets the form factor, the variation and the shares of each link, from the points of Cubature() on the
// receiver's part before the source. Sources that reflect nothing keep equal shares, since their radiosity
// stays constant. The values are useless if the context is cancelled.
void FindByCubature(ReceiverLinks* links, const ExecutionContext& context);

}  // namespace penumbra
