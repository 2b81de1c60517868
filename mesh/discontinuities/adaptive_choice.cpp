#include "mesh/discontinuities/adaptive_choice.h"

#include <memory>

#include "mesh/discontinuities/shadow_crossing.h"

namespace penumbra {
namespace {

class AdaptiveChoice final : public DiscontinuityChoiceMethod {
 public:
  LeafFilter FilterOf(const ElementForest& forest, const PatchVisibility& visibility,
                      PatchId patch) const override {
    return [crossing = std::make_shared<ShadowCrossing>(forest, visibility, patch)](
               const Discontinuity& d, ElementId leaf) { return crossing->Crosses(d.source, leaf); };
  }
};

}  // namespace

DiscontinuityChoiceRegistry::Method AdaptiveChoiceMethod() {
  return {"adaptive", "those where a shadow boundary is seen to cross a leaf (Stuerzlinger 1994)", {}, [] {
            return std::make_unique<const AdaptiveChoice>();
          }};
}

}  // namespace penumbra
