#include "solver/transport/points/factor_row.h"

namespace penumbra {

Rgb Irradiance(const FactorRow& row, std::uint32_t first, std::uint32_t end, const SourceSet& sources) {
  std::array<double, 3> sum = {0, 0, 0};
  for (std::uint32_t i = first; i < end; ++i) {
    const FactorTerm& term = row.terms[i];
    const SourceSet::NodeLight& light = sources.LightOf(term.node);
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += term.factor * light.radiosity[c] + term.moment[0] * light.slope[3 * c] +
                term.moment[1] * light.slope[3 * c + 1] + term.moment[2] * light.slope[3 * c + 2];
  }
  return {sum[0], sum[1], sum[2]};
}

Rgb Irradiance(const FactorRow& row, const SourceSet& sources) {
  return Irradiance(row, 0, static_cast<std::uint32_t>(row.terms.size()), sources).max(0.0);
}

}  // namespace penumbra
