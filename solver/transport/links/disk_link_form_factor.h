// solver/transport/links/disk_link_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The source as a disk, seen from the centre of the receiver's part before it, times the fraction of the
// source's point form factor that blockers leave there, exactly (Hanrahan, Salzman and Aupperle 1991, who
// cast rays for that): to compare. Variation and shares are those of the cubature.
LinkFormFactorRegistry::Method DiskLinkFormFactorMethod();

}  // namespace penumbra
