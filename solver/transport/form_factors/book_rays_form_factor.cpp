#include "solver/transport/form_factors/book_rays_form_factor.h"

#include <cmath>

#include "solver/transport/form_factors/source_rays.h"

namespace penumbra {
namespace {

FormFactorEstimate ByDisks(const SightedPair& pair) {
  FormFactorEstimate estimate = FactorBySourceRays(pair, RayFormula::kDisks);
  // The same rays: the difference is that of the formulas alone.
  estimate.error += std::abs(FactorBySourceRays(pair, RayFormula::kUnbiased).factor - estimate.factor);
  return estimate;
}

}  // namespace

LinkFormFactorRegistry::Method BookRaysFormFactorMethod() {
  return {"rays-book",
          "rays from a few points to random points of the source, each for a disk (Wallace, Elmquist and "
          "Haines 1989): too small by its formula",
          {"rays"},
          [](const LinkFormFactorOptions& options) {
            return std::make_unique<const PairFormFactor>(ByDisks, 4 * kSourceRays, false, options);
          }};
}

}  // namespace penumbra
