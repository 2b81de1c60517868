#include "solver/transport/links/thesis_oracle.h"

namespace penumbra {
namespace {

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

OracleRegistry::Method ThesisOracleMethod() {
  return {"thesis",
          "the error of a link as printed in the thesis, without regard to area",
          {},
          [](const OracleOptions& options) { return std::make_unique<const ThesisOracle>(options); }};
}

}  // namespace penumbra
