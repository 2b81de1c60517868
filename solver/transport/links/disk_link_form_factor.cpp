#include "solver/transport/links/disk_link_form_factor.h"

#include <memory>

#include "solver/transport/links/approximate_form_factor.h"
#include "solver/transport/links/link_cubature.h"
#include "solver/visibility/point/form_factor.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {
namespace {

double DiskFactorOf(const ReceiverLinks& links, const Link& link, const LinkView& of,
                    const OcclusionMethod& occlusion) {
  const ElementForest& forest = links.forest;
  const Element &receiver = forest[link.receiver], &source = forest[link.source];
  ReceiverPoint at;
  at.position = Centroid(of.lit.empty() ? receiver.Vertices() : std::span<const Vec3>(of.lit));
  at.normal = forest.scene().patches[receiver.patch].normal;
  PointView view(forest.scene(), at, occlusion);
  if (!view.FaceSource(source.patch)) return 0;
  const DirectionPolygon seen = view.SeeSource(source.Vertices());
  std::vector<Occluder>& occluders = view.occluder_stack();
  if (seen.empty() || !view.FindBlockers(links.set.Blockers(link), receiver.patch, seen, occluders)) return 0;
  const double whole = FormFactor(seen, at.normal);
  if (whole <= 0) return 0;
  const double disk = DiskFactor(at.position, at.normal, Centroid(source.Vertices()),
                                 forest.scene().patches[source.patch].normal, source.area);
  return of.lit_fraction * disk * view.VisibleFormFactor(seen, occluders) / whole;
}

class DiskLinkFormFactor final : public LinkFormFactorMethod {
 public:
  explicit DiskLinkFormFactor(const LinkFormFactorOptions& options)
      : factors_only_(options.factors_only), occlusion_(options.occlusion) {}

  void Find(ReceiverLinks* links, const ExecutionContext& context) const override {
    if (!factors_only_) FindByCubature(links, context, occlusion_.get());
    const OcclusionMethod& occlusion = occlusion_ ? *occlusion_ : FastestExactMethod();
    for (std::size_t i = 0; i < links->views.size(); ++i) {
      if (context.Cancelled()) return;
      Link& link = links->set.links[i];
      link.form_factor = DiskFactorOf(*links, link, links->views[i], occlusion);
    }
  }
  std::optional<FormFactorEstimate> Between(const Scene& scene, std::span<const AreaPart> from,
                                            std::span<const AreaPart> to,
                                            const ExecutionContext& context) const override {
    return DiskFormFactor(scene, from, to, context);
  }

 private:
  bool factors_only_;
  std::shared_ptr<const OcclusionMethod> occlusion_;  // null: the fastest exact method
};

}  // namespace

LinkFormFactorRegistry::Method DiskLinkFormFactorMethod() {
  return {"disk",
          "the source as a disk seen from the receiver's centre (Hanrahan, Salzman and Aupperle 1991)",
          {},
          [](const LinkFormFactorOptions& options) {
            return std::make_unique<const DiskLinkFormFactor>(options);
          }};
}

}  // namespace penumbra
