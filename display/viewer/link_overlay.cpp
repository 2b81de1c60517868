#include "display/viewer/link_overlay.h"

#include <algorithm>
#include <cmath>

#include "display/viewer/links.h"
#include "display/viewer/settings.h"

namespace penumbra::viewer {
namespace {

// The width of a link that carries so much, beside the strongest one [pixels]: areas of arrows compare.
float ArrowWidth(double carried, double strongest) {
  constexpr double kThinnest = 0.7, kWidest = 3.5;
  const double share = strongest > 0 ? carried / strongest : 0;
  return static_cast<float>(kThinnest + (kWidest - kThinnest) * std::sqrt(share));
}

class LinkOverlay final : public Overlay {
 public:
  std::string Group() const override { return "Links"; }
  std::vector<OverlaySwitch> Switches() const override {
    return {{SwitchOf(LinkClass::kVisible), "Visible links", "Visible links", "l", {}},
            {SwitchOf(LinkClass::kSplit), "Links split by a plane", "Links split by a plane", "k", {}},
            {SwitchOf(LinkClass::kPartial), "Partial links", "Partial links", "p", {}}};
  }
  void AddSettings(OverlaySettings* values, Settings* settings) const override {
    settings->Number("link-min-irradiance", Group(), "At least [W/m^2]", &values->link_min_irradiance,
                     {0, 1e12});
    settings->Integer("link-limit", Group(), "The strongest", &values->link_limit, 0, 1'000'000);
  }
  int Layer() const override { return 3; }
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    const OverlaySettings& settings = context.settings;
    const std::vector<OverlaySwitch> switches = Switches();
    if (std::none_of(switches.begin(), switches.end(),
                     [&](const OverlaySwitch& part) { return settings.Shows(part.name); }))
      return;
    if (!context.snapshot.light) return;
    // The selection draws the one that is left.
    if (context.Isolates(SelectionKind::kLink) || context.Isolates(SelectionKind::kTube)) return;
    const RadiositySolution& solution = context.snapshot.light->solution();
    double strongest = 0;
    for (const std::uint32_t i : ShownLinks(solution, settings, context.selection)) {
      const Link& link = solution.links.links[i];
      const double carried = LinkIrradiance(solution, link);
      if (strongest == 0) strongest = carried;  // the first
      const Element& receiver = solution.forest[link.receiver];
      drawing->Arrow(Centroid(solution.forest[link.source].Vertices()), Centroid(receiver.Vertices()),
                     context.snapshot.scene->patches[static_cast<std::size_t>(receiver.patch)].normal,
                     ColourOf(ClassOf(solution, link)), ArrowWidth(carried, strongest),
                     {SelectionKind::kLink, static_cast<std::int64_t>(i)});
    }
  }
};

}  // namespace

OverlayRegistry::Method LinkOverlayMethod() {
  return {"links",
          "links as arrows from source to receiver, coloured by class",
          {"link-min-irradiance", "link-limit"},
          [] { return std::make_unique<const LinkOverlay>(); }};
}

}  // namespace penumbra::viewer
