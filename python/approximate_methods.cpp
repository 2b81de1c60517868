#include "python/approximate_methods.h"

#include <algorithm>

#include "solver/base/check.h"
#include "solver/transport/form_factors/link_form_factor_methods.h"

namespace penumbra {
namespace {

constexpr const char* kExactFactors = "exact";   // integrated to a tolerance, not approximated
constexpr std::uint64_t kUsualRays = 1'000'000;  // as the command form-factor casts

}  // namespace

std::vector<std::string> ApproximateMethods() {
  std::vector<std::string> names = LinkFormFactorMethods().Names();
  std::erase(names, kExactFactors);
  return names;
}

bool Takes(const std::string& method, const std::string& parameter) {
  for (const LinkFormFactorRegistry::Method& of : LinkFormFactorMethods().methods())
    if (of.name == method)
      return std::find(of.parameters.begin(), of.parameters.end(), parameter) != of.parameters.end();
  return false;
}

FormFactorEstimate ApproximateFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                         std::span<const AreaPart> to, const ApproximateRequest& request,
                                         const ExecutionContext& context) {
  LinkFormFactorOptions options;
  options.resolution = static_cast<std::size_t>(request.resolution.value_or(0));
  options.rays = static_cast<std::size_t>(request.rays.value_or(kUsualRays));
  options.seed = request.seed;
  const std::optional<FormFactorEstimate> found =
      LinkFormFactorMethods().Make(request.method, options)->Between(scene, from, to, context);
  if (!found)
    throw InputError("method='" + request.method + "' finds form factors of links only; give another");
  return *found;
}

}  // namespace penumbra
