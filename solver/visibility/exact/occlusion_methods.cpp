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

std::vector<std::string> OcclusionNames() {
  std::vector<std::string> names = OcclusionMethods().Names();
  names.insert(names.begin(), std::string(kFastestOcclusion));
  return names;
}

std::unique_ptr<const OcclusionMethod> MakeOcclusion(std::string_view name, const OcclusionOptions& options) {
  return name == kFastestOcclusion ? nullptr : OcclusionMethods().Make(name, options);
}

}  // namespace penumbra
