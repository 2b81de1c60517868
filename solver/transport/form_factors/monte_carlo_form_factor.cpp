#include "solver/transport/form_factors/monte_carlo_form_factor.h"

#include "solver/transport/form_factors/pair_form_factor.h"

namespace penumbra {
namespace {

constexpr std::size_t kPairsOfPoints = 256;

FormFactorEstimate ByPairsOfPoints(const SightedPair& pair) {
  Random random = pair.of_pair;
  const double area = VectorArea(pair.target).norm();
  SampleMean mean;
  for (std::size_t i = 0; i < pair.rays; ++i) {
    const double s = random.Uniform(), t = random.Uniform(), u = random.Uniform(), v = random.Uniform();
    const Vec3 from = UniformPoint(pair.sender, s, t), to = UniformPoint(pair.target, u, v);
    const double value = area * PointKernel(pair, from, to);
    mean.Add(value > 0 && InSight(pair, from, to) ? value : 0, value);
  }
  return mean.Estimate();
}

}  // namespace

LinkFormFactorRegistry::Method MonteCarloFormFactorMethod() {
  return {"monte-carlo",
          "the double integral over both areas at random pairs of points",
          {"rays"},
          [](const LinkFormFactorOptions& options) {
            return std::make_unique<const PairFormFactor>(ByPairsOfPoints, kPairsOfPoints, true, options);
          }};
}

}  // namespace penumbra
