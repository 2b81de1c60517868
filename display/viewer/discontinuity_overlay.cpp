#include "display/viewer/discontinuity_overlay.h"

#include "display/viewer/settings.h"

namespace penumbra::viewer {
namespace {

// Colours that differ in lightness as well.
Colour ColourOfKind(DiscontinuityKind kind) {
  switch (kind) {
    case DiscontinuityKind::kVE:
      return colour::kViolet;
    case DiscontinuityKind::kEV:
      return colour::kOrange;
    case DiscontinuityKind::kHorizon:
      return colour::kYellow;
    case DiscontinuityKind::kContact:
      return colour::kRed;
    case DiscontinuityKind::kEEE:
      return colour::kCyan;
    case DiscontinuityKind::kNear:
      return colour::kGrey;
  }
  return colour::kViolet;
}

class DiscontinuityOverlay final : public Overlay {
 public:
  std::vector<OverlaySwitch> Switches() const override {
    return {{"discontinuities", "All discontinuities", "Discontinuities", "x", {.discontinuities = true}}};
  }
  void AddSettings(OverlaySettings* values, Settings* settings) const override {
    using enum DiscontinuityKind;
    settings->Choice("discontinuity-kind", Group(), "Discontinuities of the kind",
                     &values->discontinuity_kind,
                     {{"all", std::nullopt},
                      {"VE", kVE},
                      {"EV", kEV},
                      {"horizon", kHorizon},
                      {"contact", kContact},
                      {"EEE", kEEE},
                      {"near", kNear}});
    settings->Number("discontinuity-weight", Group(), "that weigh at least [W/m^2]",
                     &values->discontinuity_min_weight, {0, 1e12});
    settings->Toggle("discontinuity-colours", Group(), "in colours by kind",
                     &values->discontinuities_by_kind);
  }
  int Layer() const override { return 2; }
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    if (!context.settings.Shows("discontinuities") || !context.results.discontinuities) return;
    if (context.Isolates(SelectionKind::kDiscontinuity)) return;  // the selection draws it
    const DiscontinuityList& list = *context.results.discontinuities;
    const bool one = context.selection.kind == SelectionKind::kElement && context.snapshot.light;
    const OverlaySettings& settings = context.settings;
    for (std::size_t i = 0; i < list.all.size(); ++i) {
      const Discontinuity& d = list.all[i];
      if (settings.discontinuity_kind && d.kind != *settings.discontinuity_kind) continue;
      if (d.weight < settings.discontinuity_min_weight) continue;
      if (one &&
          context.snapshot.light->solution().forest[static_cast<ElementId>(context.selection.index)].patch !=
              d.receiver)
        continue;
      const Colour shown = settings.discontinuities_by_kind ? ColourOfKind(d.kind) : colour::kViolet;
      drawing->Line(list.ends[i][0], list.ends[i][1], shown, 1.0F,
                    {SelectionKind::kDiscontinuity, static_cast<std::int64_t>(i)});
    }
  }
};

}  // namespace

OverlayRegistry::Method DiscontinuityOverlayMethod() {
  return {"discontinuities",
          "all potential discontinuities",
          {"discontinuity-kind", "discontinuity-weight", "discontinuity-colours"},
          [] { return std::make_unique<const DiscontinuityOverlay>(); }};
}

}  // namespace penumbra::viewer
