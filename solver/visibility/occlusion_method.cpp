#include "solver/visibility/occlusion_method.h"

#include <string>

#include "solver/base/check.h"
#include "solver/visibility/clipping.h"

namespace penumbra {

std::vector<std::string> OcclusionMethodNames() { return {"clipping"}; }

std::unique_ptr<const OcclusionMethod> MakeOcclusionMethod(std::string_view name) {
  if (name == "clipping") return std::make_unique<Clipping>();
  throw InputError("no method is called '" + std::string(name) + "'");
}

const OcclusionMethod& FastestExactMethod() {
  static const Clipping method;
  return method;
}

}  // namespace penumbra
