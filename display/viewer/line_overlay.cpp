#include "display/viewer/line_overlay.h"

namespace penumbra::viewer {
namespace {

class LineOverlay final : public Overlay {
 public:
  int Layer() const override { return 7; }
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    if (!context.results.line_plot) return;
    const auto& ends = context.results.line_plot->line.ends;
    drawing->Line(ends[0], ends[1], colour::kYellow, 2.5F);
    for (const Vec3& end : ends) drawing->points.push_back({end, colour::kYellow, 4.0F});
  }
};

}  // namespace

OverlayRegistry::Method LineOverlayMethod() {
  return {"line", "the line over which light is plotted", {}, [] {
            return std::make_unique<const LineOverlay>();
          }};
}

}  // namespace penumbra::viewer
