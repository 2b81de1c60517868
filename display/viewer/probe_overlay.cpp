#include "display/viewer/probe_overlay.h"

namespace penumbra::viewer {
namespace {

class ProbeOverlay final : public Overlay {
 public:
  int Layer() const override { return 7; }
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    if (!context.results.probe) return;
    const ProbeResult& probe = *context.results.probe;
    const Vec3 up = context.settings.graph_scale *
                    context.snapshot.scene->patches[static_cast<std::size_t>(probe.at.patch)].normal;
    drawing->Line(probe.at.position, probe.at.position + probe.exact.mean() * up, colour::kWhite, 2.5F);
    drawing->points.push_back({probe.at.position, colour::kYellow, 4.0F});
  }
};

}  // namespace

OverlayRegistry::Method ProbeOverlayMethod() {
  return {"probe", "the irradiance at a probed point, as a stick", {}, [] {
            return std::make_unique<const ProbeOverlay>();
          }};
}

}  // namespace penumbra::viewer
