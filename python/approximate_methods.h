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
  std::string method;  // one of the names of ApproximateMethods()
  std::optional<std::uint64_t> rays, resolution;
  std::uint64_t seed = 1;
};

// The names of the methods by which form factors between areas can be approximated.
std::vector<std::string> ApproximateMethods();
// True if the method has the parameter called `parameter`, such as "rays" or "resolution".
bool Takes(const std::string& method, const std::string& parameter);

// Computes the form factor from `from` to `to` by the approximate method `request.method`. Throws InputError
// if the method can compute only the form factors of links in a hierarchy of elements. REQUIRES:
// `request.method` is one of ApproximateMethods().
FormFactorEstimate ApproximateFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                         std::span<const AreaPart> to, const ApproximateRequest& request,
                                         const ExecutionContext& context);

}  // namespace penumbra
