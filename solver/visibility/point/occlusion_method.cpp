#include "solver/visibility/point/occlusion_method.h"

#include "solver/base/check.h"
#include "solver/visibility/exact/backprojection.h"
#include "solver/visibility/exact/vertex_tracing.h"
#include "solver/visibility/point/clipping.h"
#include "solver/visibility/point/sampled_visibility.h"

namespace penumbra {

std::vector<std::string> OcclusionMethodNames() {
  return {"clipping", "backprojection", "vertex-tracing", "sampled"};
}

std::unique_ptr<const OcclusionMethod> MakeOcclusionMethod(std::string_view name,
                                                           const OcclusionOptions& options) {
  if (name == "clipping") return std::make_unique<Clipping>();
  if (name == "backprojection") return std::make_unique<Backprojection>(options.min_backprojection_segment);
  if (name == "vertex-tracing") return std::make_unique<VertexTracing>();
  if (name == "sampled") return std::make_unique<SampledVisibility>();
  throw InputError("no method is called '" + std::string(name) + "'");
}

const OcclusionMethod& FastestExactMethod() {
  static const Clipping method;
  return method;
}

}  // namespace penumbra
