#include "python/approximate_methods.h"

#include "solver/transport/links/approximate_form_factor.h"

namespace penumbra {
namespace {

constexpr const char* kCubature = "cubature";
constexpr const char* kDisk = "disk";
constexpr const char* kMonteCarlo = "monte-carlo";
constexpr std::uint64_t kUsualRays = 1'000'000;  // as the command form-factor casts

}  // namespace

std::vector<std::string> ApproximateMethods() { return {kCubature, kDisk, kMonteCarlo}; }

bool CastsRays(const std::string& method) { return method == kMonteCarlo; }

FormFactorEstimate ApproximateFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                         std::span<const AreaPart> to, const ApproximateRequest& request,
                                         const ExecutionContext& context) {
  if (request.method == kDisk) return DiskFormFactor(scene, from, to, context);
  if (request.method == kCubature) return CubatureFormFactor(scene, from, to, context);
  return MonteCarloFormFactor(scene, from, to, request.rays.value_or(kUsualRays), request.seed, context);
}

}  // namespace penumbra
