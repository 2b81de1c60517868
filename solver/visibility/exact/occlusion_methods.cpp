#include "solver/visibility/exact/occlusion_methods.h"

#include "solver/visibility/exact/backprojection.h"
#include "solver/visibility/exact/vertex_tracing.h"
#include "solver/visibility/point/clipping.h"
#include "solver/visibility/point/sampled_visibility.h"

namespace penumbra {

OcclusionRegistry& OcclusionMethods() {
  static OcclusionRegistry registry("occlusion method", {ClippingMethod(), BackprojectionMethod(),
                                                         VertexTracingMethod(), SampledVisibilityMethod()});
  return registry;
}

}  // namespace penumbra
