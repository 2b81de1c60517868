#include "solver/transport/links/transport_oracle.h"

#include "solver/transport/links/area_weighted_oracle.h"

namespace penumbra {
namespace {

class TransportOracle final : public AreaWeightedOracle {
 public:
  using AreaWeightedOracle::AreaWeightedOracle;

 private:
  double Deviation(const ElementForest&, const Link& link) const override { return link.variation; }
};

}  // namespace

OracleRegistry::Method TransportOracleMethod() {
  return {"transport",
          "the error of a link by the deviation of its form factor over the receiver",
          {},
          [](const OracleOptions& options) { return std::make_unique<const TransportOracle>(options); }};
}

}  // namespace penumbra
