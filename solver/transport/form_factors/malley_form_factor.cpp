#include "solver/transport/form_factors/malley_form_factor.h"

#include <cmath>
#include <numbers>

#include "solver/transport/form_factors/pair_form_factor.h"

namespace penumbra {
namespace {

constexpr std::size_t kMalleyRays = 4096;

// True if the ray first meets the target, on its front.
bool MeetsTarget(const SightedPair& pair, const Vec3& origin, const Vec3& direction) {
  const Vec3& normal = pair.TargetNormal();
  const double slope = normal.dot(direction), height = normal.dot(pair.target[0] - origin);
  if (slope >= 0 || height >= 0) return false;
  const Vec3 met = origin + height / slope * direction;
  return ConvexContains(pair.target, normal, met, 0) && InSight(pair, origin, met);
}

FormFactorEstimate ByHemisphereRays(const SightedPair& pair) {
  Random random = pair.of_sender;
  const Frame frame = MakeFrame(Vec3::Zero(), pair.SenderNormal());
  double hits = 0;
  for (std::size_t i = 0; i < pair.rays; ++i) {
    const double s = random.Uniform(), t = random.Uniform(), square = random.Uniform(),
                 angle = random.Uniform(0, 2 * std::numbers::pi);
    const Vec3 direction = std::sqrt(square) * (std::cos(angle) * frame.u + std::sin(angle) * frame.v) +
                           std::sqrt(1 - square) * frame.n;
    if (MeetsTarget(pair, UniformPoint(pair.sender, s, t), direction)) ++hits;
  }
  const auto n = static_cast<double>(pair.rays);
  const double likely = (hits + 1) / (n + 2);  // never certain
  FormFactorEstimate estimate;
  estimate.factor = hits / n;
  estimate.error = std::sqrt(likely * (1 - likely) / n);
  estimate.points = pair.rays;
  return estimate;
}

}  // namespace

LinkFormFactorRegistry::Method MalleyFormFactorMethod() {
  return {"malley",
          "the share of cosine-distributed rays that hits (Malley 1988)",
          {"rays"},
          [](const LinkFormFactorOptions& options) {
            return std::make_unique<const PairFormFactor>(ByHemisphereRays, kMalleyRays, true, options);
          }};
}

}  // namespace penumbra
