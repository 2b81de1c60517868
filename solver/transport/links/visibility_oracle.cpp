#include "solver/transport/links/visibility_oracle.h"

#include "solver/transport/links/area_weighted_oracle.h"

namespace penumbra {
namespace {

// Factor on the deviation of partial links.
constexpr double kPartialCost = 2;

class VisibilityOracle final : public AreaWeightedOracle {
 public:
  using AreaWeightedOracle::AreaWeightedOracle;

 private:
  double Deviation(const ElementForest&, const Link& link) const override {
    return (link.visibility == Visibility::kPartial ? kPartialCost : 1) * link.variation;
  }
};

}  // namespace

OracleRegistry::Method VisibilityOracleMethod() {
  return {"visibility",
          "as transport, but the deviation of a partly hidden link counts twice",
          {},
          [](const OracleOptions& options) { return std::make_unique<const VisibilityOracle>(options); }};
}

}  // namespace penumbra
