// solver/visibility/exact/occlusion_methods.h

#pragma once

#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {

// The registry of all occlusion methods; the fastest exact method comes first.
OcclusionRegistry& OcclusionMethods();

}  // namespace penumbra
