// solver/transport/links/disk_link_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// A form-factor method for comparison: approximates the form factor of a link by (form factor of a point of
// the receiver to a disk that replaces the source) * (visible fraction of the source). The form factor is
// computed from one point of the receiver: the centroid of that part of the receiver that lies in front of
// the source's plane. The visible fraction of the source is the exact ratio (form factor of the point to the
// visible part of the source) / (form factor of the point to the whole source), whereas Hanrahan, Salzman and
// Aupperle (1991) estimate the fraction by rays. Link::variation and Link::share are computed by
// FindByCubature().
LinkFormFactorRegistry::Method DiskLinkFormFactorMethod();

}  // namespace penumbra
