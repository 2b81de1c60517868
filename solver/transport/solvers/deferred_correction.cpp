#include "solver/transport/solvers/deferred_correction.h"

namespace penumbra {

void DeferredCorrection::AddDifference(const RadiositySolution& solution, std::span<const Rgb> exact) {
  of_element.resize(solution.forest.size(), Rgb::Zero());
  for (const ElementId leaf : solution.forest.AllLeaves())
    of_element[static_cast<std::size_t>(leaf)] +=
        exact[static_cast<std::size_t>(leaf)] - solution.irradiance[static_cast<std::size_t>(leaf)];
}

void DeferredCorrection::LightFragments(RadiositySolution& solution) const {
  for (std::size_t i = 0; i < solution.fragments.size(); ++i) {
    Fragment& fragment = solution.fragments[i];
    const Material& material = solution.forest.scene().MaterialOf(solution.forest[fragment.leaf].patch);
    fragment.irradiance =
        (solution.irradiance[static_cast<std::size_t>(fragment.leaf)] + of_fragment[i]).max(0.0);
    fragment.radiosity = material.emittance + material.reflectance * fragment.irradiance;
  }
}

}  // namespace penumbra
