// The irradiance at a probed point as a white stick (thesis B.4.9), and what its sources look like from it
// (B.4.10).

#include "display/viewer/overlay.h"

namespace penumbra::viewer {
namespace {

class ProbeOverlay final : public Overlay {
 public:
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    if (!context.results.probe) return;
    const ProbeResult& probe = *context.results.probe;
    const Vec3 up = context.settings.graph_scale *
                    context.snapshot.scene->patches[static_cast<std::size_t>(probe.at.patch)].normal;
    drawing->Line(probe.at.position, probe.at.position + probe.exact.mean() * up, colour::kWhite, 2.5F);
    drawing->points.push_back({probe.at.position, colour::kYellow, 4.0F});
  }
};

class BackprojectionOverlay final : public Overlay {
 public:
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

std::unique_ptr<Overlay> MakeProbeOverlay() { return std::make_unique<ProbeOverlay>(); }
std::unique_ptr<Overlay> MakeBackprojectionOverlay() { return std::make_unique<BackprojectionOverlay>(); }

}  // namespace penumbra::viewer
