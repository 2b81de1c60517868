#include "solver/transport/links/size_oracle.h"

#include "solver/geometry/polygon.h"

namespace penumbra {
namespace {

constexpr double kLargestOfDistance = 0.25;

class SizeOracle final : public RefinementOracle {
 public:
  explicit SizeOracle(double min_area) : min_area_(min_area) {}

  Refinement Judge(const RadiositySolution& solution, const Link& link) const override {
    const Element &receiver = solution.forest[link.receiver], &source = solution.forest[link.source];
    const double distance = (Centroid(receiver.Vertices()) - Centroid(source.Vertices())).norm();
    const double largest = kLargestOfDistance * distance;
    const double of_receiver = Diameter(receiver.Vertices()), of_source = Diameter(source.Vertices());
    const bool receiver_first = of_receiver >= of_source;
    if (of_receiver > largest && receiver_first && MaySplit(receiver, min_area_))
      return Refinement::kSplitReceiver;
    if (of_source > largest && MaySplit(source, min_area_)) return Refinement::kSplitSource;
    return of_receiver > largest && MaySplit(receiver, min_area_) ? Refinement::kSplitReceiver
                                                                  : Refinement::kAccept;
  }

 private:
  double min_area_;
};

}  // namespace

OracleRegistry::Method SizeOracleMethod() {
  return {"size",
          "splits what is large beside the distance, whatever its light",
          {},
          [](const OracleOptions& options) { return std::make_unique<const SizeOracle>(options.min_area); }};
}

}  // namespace penumbra
