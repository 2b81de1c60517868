#include "display/viewer/backprojection_overlay.h"

namespace penumbra::viewer {
namespace {

class BackprojectionOverlay final : public Overlay {
 public:
  int Layer() const override { return 6; }
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    if (!context.results.backprojection) return;
    for (const BackprojectedPatch& patch : *context.results.backprojection) {
      for (const auto& triangle : patch.visible) drawing->Fill(triangle, colour::kWhite, 0.45F);
      for (const auto& edge : patch.triangulation) drawing->Line(edge[0], edge[1], colour::kGreen, 1.0F);
      for (const auto& edge : patch.blockers) drawing->Line(edge[0], edge[1], colour::kViolet, 1.6F);
    }
  }
};

}  // namespace

OverlayRegistry::Method BackprojectionOverlayMethod() {
  return {"backprojection", "what the sources look like from a probed point", {}, [] {
            return std::make_unique<const BackprojectionOverlay>();
          }};
}

}  // namespace penumbra::viewer
