// solver/visibility/exact/occlusion_methods.h

#pragma once

#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {

// Every occlusion method there is, the fastest exact one first.
OcclusionRegistry& OcclusionMethods();

}  // namespace penumbra
