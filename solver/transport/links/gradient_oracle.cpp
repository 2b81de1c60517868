#include "solver/transport/links/gradient_oracle.h"

#include <algorithm>
#include <cmath>

#include "solver/transport/links/area_weighted_oracle.h"
#include "solver/transport/links/cubature.h"
#include "solver/visibility/point/form_factor.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {
namespace {

class GradientOracle final : public AreaWeightedOracle {
 public:
  using AreaWeightedOracle::AreaWeightedOracle;

 private:
  double Deviation(const ElementForest& forest, const Link& link) const override {
    const Element& receiver = forest[link.receiver];
    const Element& source = forest[link.source];
    ReceiverPoint at;
    at.position = Centroid(receiver.Vertices());
    at.normal = forest.scene().patches[receiver.patch].normal;
    PointView view(forest.scene(), at);
    // If the centre does not see the source's front, only the sampled points give a deviation.
    if (!view.FaceSource(source.patch) || view.SourceInContact()) return link.variation;
    const Vec3 gradient = FormFactorGradient(view.SeeSource(source.Vertices()), at.normal);
    double square = 0;  // the rule is exact for the squared linear function: its degree is at least 2
    for (const CubaturePoint& point : Cubature(receiver.Vertices(), 0)) {
      const double deviation = gradient.dot(point.position - at.position);
      square += point.weight * deviation * deviation;
    }
    const double deviation = std::sqrt(square);
    return link.visibility == Visibility::kPartial ? std::max(deviation, link.variation) : deviation;
  }
};

}  // namespace

OracleRegistry::Method GradientOracleMethod() {
  return {"gradient",
          "the error of a link by the gradient of its form factor at the receiver's centre",
          {},
          [](const OracleOptions& options) { return std::make_unique<const GradientOracle>(options); }};
}

}  // namespace penumbra
