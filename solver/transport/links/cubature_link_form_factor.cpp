#include "solver/transport/links/cubature_link_form_factor.h"

#include <memory>
#include <utility>

#include "solver/transport/links/approximate_form_factor.h"
#include "solver/transport/links/link_cubature.h"

namespace penumbra {
namespace {

class CubatureLinkFormFactor final : public LinkFormFactorMethod {
 public:
  explicit CubatureLinkFormFactor(std::shared_ptr<const OcclusionMethod> occlusion)
      : occlusion_(std::move(occlusion)) {}

  void Find(ReceiverLinks* links, const ExecutionContext& context) const override {
    FindByCubature(links, context, occlusion_.get());
  }
  std::optional<FormFactorEstimate> Between(const Scene& scene, std::span<const AreaPart> from,
                                            std::span<const AreaPart> to,
                                            const ExecutionContext& context) const override {
    return CubatureFormFactor(scene, from, to, context);
  }

 private:
  std::shared_ptr<const OcclusionMethod> occlusion_;  // null: the fastest exact method
};

}  // namespace

LinkFormFactorRegistry::Method CubatureLinkFormFactorMethod() {
  return {"cubature",
          "the mean of exact point factors over a few points of the receiver",
          {},
          [](const LinkFormFactorOptions& options) {
            return std::make_unique<const CubatureLinkFormFactor>(options.occlusion);
          }};
}

}  // namespace penumbra
