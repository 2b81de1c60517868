// solver/transport/links/disk_link_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// For comparison: the form factor to a disk in place of the source, from the centre of the receiver's part
// before the source, times the fraction of the source's point form factor that blockers leave visible there.
// The fraction is exact; Hanrahan, Salzman and Aupperle (1991) cast rays. Variation and shares are those of
// the cubature.
LinkFormFactorRegistry::Method DiskLinkFormFactorMethod();

}  // namespace penumbra
