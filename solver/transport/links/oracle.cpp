#include "solver/transport/links/oracle.h"

#include <algorithm>
#include <cmath>

#include "solver/transport/links/cubature.h"
#include "solver/visibility/point/form_factor.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {
namespace {

// What a receiver's irradiance deviates by averages out over the receiver; what a source's uneven radiosity
// brings does not: near bright parts of a wall receivers are bright, so that it errs to the dark side on
// every link and adds up to some hundredths of missing energy. Deferred correction takes most of that away;
// this share of eps leaves it little to do. (Without it, 0.004 balances the energy of closed boxes to 1e-3,
// with five times the links.)
constexpr double kSourceShare = 0.3;

// How much more the deviation of a partial link counts, where visibility does.
constexpr double kPartialCost = 2;

bool MaySplit(const Element& element, double min_area) {
  return element.area >= 4 * min_area && element.level < kMaxLevel;
}

// Weighs both errors of a link by the receiver's area, and splits the end that errs more.
class AreaWeightedOracle : public RefinementOracle {
 public:
  explicit AreaWeightedOracle(const OracleOptions& options) : options_(options) {}

  Refinement Judge(const RadiositySolution& solution, const Link& link) const override {
    const Element& receiver = solution.forest[link.receiver];
    const double weight = std::sqrt(receiver.area / options_.reference_area);
    const double receiver_error =
        weight * solution.radiosity[link.source].maxCoeff() * Deviation(solution.forest, link);
    // The shares of the quarters carry the source's own unevenness: what is left is that of its children,
    // whose form factor varies half as much.
    const double source_error =
        weight * 0.5 * link.source_variation * link.form_factor * solution.spread_below[link.source];
    // A source is split only where it has children: its light is no more detailed than its tree.
    const bool source_may = !solution.forest[link.source].IsLeaf();
    const bool split_receiver = MaySplit(receiver, options_.min_area) && receiver_error > options_.eps;
    const bool split_source = source_may && source_error > kSourceShare * options_.eps;
    if (split_receiver && (!split_source || receiver_error >= source_error))
      return Refinement::kSplitReceiver;
    return split_source ? Refinement::kSplitSource : Refinement::kAccept;
  }

 private:
  // The root mean square deviation of the point form factors over the receiver [1].
  virtual double Deviation(const ElementForest& forest, const Link& link) const = 0;

  OracleOptions options_;
};

class TransportOracle final : public AreaWeightedOracle {
 public:
  using AreaWeightedOracle::AreaWeightedOracle;

 private:
  double Deviation(const ElementForest&, const Link& link) const override { return link.variation; }
};

class VisibilityOracle final : public AreaWeightedOracle {
 public:
  using AreaWeightedOracle::AreaWeightedOracle;

 private:
  double Deviation(const ElementForest&, const Link& link) const override {
    return (link.visibility == Visibility::kPartial ? kPartialCost : 1) * link.variation;
  }
};

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
    // Where the centre does not see the source's front, all that is known are the points that were sampled.
    if (!view.FaceSource(source.patch) || view.SourceInContact()) return link.variation;
    const Vec3 gradient = FormFactorGradient(view.SeeSource(source.Vertices()), at.normal);
    double square = 0;  // the rule is exact for it: its degree is 2 or more
    for (const CubaturePoint& point : Cubature(receiver.Vertices(), 0)) {
      const double deviation = gradient.dot(point.position - at.position);
      square += point.weight * deviation * deviation;
    }
    const double deviation = std::sqrt(square);
    return link.visibility == Visibility::kPartial ? std::max(deviation, link.variation) : deviation;
  }
};

class ThesisOracle final : public RefinementOracle {
 public:
  explicit ThesisOracle(const OracleOptions& options) : options_(options) {}

  Refinement Judge(const RadiositySolution& solution, const Link& link) const override {
    if (solution.radiosity[link.source].maxCoeff() * link.variation <= options_.eps)
      return Refinement::kAccept;
    const Element& receiver = solution.forest[link.receiver];
    const Element& source = solution.forest[link.source];
    const bool receiver_may = MaySplit(receiver, options_.min_area);
    const bool source_may = MaySplit(source, options_.min_area);
    if (receiver_may && (!source_may || receiver.area >= source.area)) return Refinement::kSplitReceiver;
    return source_may ? Refinement::kSplitSource : Refinement::kAccept;
  }

 private:
  OracleOptions options_;
};

}  // namespace

std::unique_ptr<const RefinementOracle> MakeOracle(OracleKind kind, const OracleOptions& options) {
  switch (kind) {
    case OracleKind::kVisibility:
      return std::make_unique<VisibilityOracle>(options);
    case OracleKind::kGradient:
      return std::make_unique<GradientOracle>(options);
    case OracleKind::kThesis:
      return std::make_unique<ThesisOracle>(options);
    case OracleKind::kTransport:
      break;
  }
  return std::make_unique<TransportOracle>(options);
}

}  // namespace penumbra
