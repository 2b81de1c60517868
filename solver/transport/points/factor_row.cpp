#include "solver/transport/points/factor_row.h"

namespace penumbra {

Rgb Irradiance(const FactorRow& row, std::uint32_t first, std::uint32_t end, const SourceSet& sources) {
  Rgb sum = Rgb::Zero();
  for (std::uint32_t i = first; i < end; ++i) {
    const FactorTerm& term = row.terms[i];
    const SourceSet::Node& node = sources.NodeAt(static_cast<std::size_t>(term.node));
    sum += static_cast<double>(term.factor) * node.radiosity;
    if (node.skip == 1) continue;  // constant
    const Vec3 moment(term.moment[0], term.moment[1], term.moment[2]);
    sum += (node.slope * moment).array();
  }
  return sum;
}

Rgb Irradiance(const FactorRow& row, const SourceSet& sources) {
  return Irradiance(row, 0, static_cast<std::uint32_t>(row.terms.size()), sources).max(0.0);
}

}  // namespace penumbra
