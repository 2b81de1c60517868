#include "solver/transport/form_factors/rays_form_factor.h"

#include "solver/transport/form_factors/source_rays.h"

namespace penumbra {

LinkFormFactorRegistry::Method RaysFormFactorMethod() {
  return {"rays",
          "rays from a few points to random points of the source, without bias",
          {"rays"},
          [](const LinkFormFactorOptions& options) {
            return std::make_unique<const PairFormFactor>(
                [](const SightedPair& pair) { return FactorBySourceRays(pair, RayFormula::kUnbiased); },
                4 * kSourceRays, false, options);
          }};
}

}  // namespace penumbra
