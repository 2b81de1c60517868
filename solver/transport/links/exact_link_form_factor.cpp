#include "solver/transport/links/exact_link_form_factor.h"

#include "solver/transport/links/link_cubature.h"
#include "solver/visibility/area/area_form_factor.h"

namespace penumbra {
namespace {

AreaPart PartOf(const Element& element) {
  return {element.patch, {element.Vertices().begin(), element.Vertices().end()}};
}

class ExactLinkFormFactor final : public LinkFormFactorMethod {
 public:
  explicit ExactLinkFormFactor(const LinkFormFactorOptions& options) : options_(options) {}

  void Find(ReceiverLinks* links, const ExecutionContext& context) const override {
    if (!options_.factors_only) FindByCubature(links, context, options_.occlusion.get());
    AreaFormFactorOptions options;
    options.tolerance = options_.tolerance;
    options.max_points = options_.max_points;
    options.method = options_.occlusion.get();
    options.context = &context;
    const ElementForest& forest = links->forest;
    for (Link& link : links->set.links) {
      if (context.Cancelled()) return;
      const std::span<const PatchId> blockers = links->set.Blockers(link);
      const PatchHierarchy between(forest.scene(), {blockers.begin(), blockers.end()});
      link.form_factor = AreaFormFactor(forest.scene(), between, PartOf(forest[link.receiver]),
                                        PartOf(forest[link.source]), options)
                             .factor;
    }
  }
  std::optional<FormFactorEstimate> Between(const Scene& scene, std::span<const AreaPart> from,
                                            std::span<const AreaPart> to,
                                            const ExecutionContext& context) const override {
    AreaFormFactorOptions options;
    options.tolerance = options_.tolerance;
    options.context = &context;
    return AreaFormFactor(scene, from, to, options);
  }

 private:
  LinkFormFactorOptions options_;
};

}  // namespace

LinkFormFactorRegistry::Method ExactLinkFormFactorMethod() {
  return {"exact",
          "between areas, to 1e-7; slower, but the factors of closed rooms add up to 1",
          {},
          [](const LinkFormFactorOptions& options) {
            return std::make_unique<const ExactLinkFormFactor>(options);
          }};
}

}  // namespace penumbra
