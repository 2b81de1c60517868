#include "mesh/discontinuities/ranked_choice.h"

namespace penumbra {
namespace {

class RankedChoice final : public DiscontinuityChoiceMethod {
 public:
  bool ByWeightAlone() const override { return true; }
};

}  // namespace

DiscontinuityChoiceRegistry::Method RankedChoiceMethod() {
  return {"ranked", "the heaviest, as many as a leaf may have", {"min-wanted-weight"}, [] {
            return std::make_unique<const RankedChoice>();
          }};
}

}  // namespace penumbra
