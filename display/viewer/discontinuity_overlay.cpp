#include "display/viewer/discontinuity_overlay.h"

namespace penumbra::viewer {
namespace {

class DiscontinuityOverlay final : public Overlay {
 public:
  std::vector<OverlaySwitch> Switches() const override {
    return {{"discontinuities", "All discontinuities", "Discontinuities", "x", {.discontinuities = true}}};
  }
  int Layer() const override { return 2; }
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    if (!context.settings.Shows("discontinuities") || !context.results.discontinuities) return;
    if (context.Isolates(SelectionKind::kDiscontinuity)) return;  // the selection draws it
    const DiscontinuityList& list = *context.results.discontinuities;
    const bool one = context.selection.kind == SelectionKind::kElement && context.snapshot.light;
    for (std::size_t i = 0; i < list.all.size(); ++i) {
      if (one &&
          context.snapshot.light->solution().forest[static_cast<ElementId>(context.selection.index)].patch !=
              list.all[i].receiver)
        continue;
      drawing->Line(list.ends[i][0], list.ends[i][1], colour::kViolet, 1.0F,
                    {SelectionKind::kDiscontinuity, static_cast<std::int64_t>(i)});
    }
  }
};

}  // namespace

OverlayRegistry::Method DiscontinuityOverlayMethod() {
  return {"discontinuities", "all potential discontinuities", {}, [] {
            return std::make_unique<const DiscontinuityOverlay>();
          }};
}

}  // namespace penumbra::viewer
