// python/approximate_methods.h

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/base/progress.h"
#include "solver/visibility/area/area_form_factor.h"

namespace penumbra {

struct ApproximateRequest {
  std::string method;  // in ApproximateMethods()
  std::optional<std::uint64_t> rays, resolution;
  std::uint64_t seed = 1;
};

// The names of the methods that approximate form factors between areas.
std::vector<std::string> ApproximateMethods();
// Whether the method has this parameter, such as "rays" or "resolution".
bool Takes(const std::string& method, const std::string& parameter);

// The form factor by one of these methods. Throws InputError if the method finds form factors of links only.
// REQUIRES: ApproximateMethods() has the method.
FormFactorEstimate ApproximateFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                         std::span<const AreaPart> to, const ApproximateRequest& request,
                                         const ExecutionContext& context);

}  // namespace penumbra
