#include "mesh/discontinuities/none_choice.h"

namespace penumbra {
namespace {

class NoneChoice final : public DiscontinuityChoiceMethod {
 public:
  bool TakesAny() const override { return false; }
};

}  // namespace

DiscontinuityChoiceRegistry::Method NoneChoiceMethod() {
  return {"none", "none", {}, [] { return std::make_unique<const NoneChoice>(); }};
}

}  // namespace penumbra
