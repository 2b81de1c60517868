// solver/transport/form_factors/centroid_form_factor.h

#pragma once

#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// The form-factor method `centroids`: A cos cos / (pi r^2) between the centroids of both areas, or 0 if a
// patch lies between the centroids. The stated error is the difference from the form factor of a disk, A cos
// cos / (pi r^2 + A).
LinkFormFactorRegistry::Method CentroidFormFactorMethod();

}  // namespace penumbra
