// Links as arrows from source to receiver, coloured by class (thesis B.4.3).

#include "display/viewer/links.h"
#include "display/viewer/overlay.h"

namespace penumbra::viewer {
namespace {

class LinkOverlay final : public Overlay {
 public:
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    const OverlaySettings& settings = context.settings;
    if (!settings.visible_links && !settings.split_links && !settings.partial_links) return;
    if (!context.snapshot.light) return;
    // The selection draws the one that is left.
    if (context.Isolates(SelectionKind::kLink) || context.Isolates(SelectionKind::kTube)) return;
    const RadiositySolution& solution = context.snapshot.light->solution();
    for (const std::uint32_t i : ShownLinks(solution, settings, context.selection)) {
      const Link& link = solution.links.links[i];
      const Element& receiver = solution.forest[link.receiver];
      drawing->Arrow(Centroid(solution.forest[link.source].Vertices()), Centroid(receiver.Vertices()),
                     context.snapshot.scene->patches[static_cast<std::size_t>(receiver.patch)].normal,
                     ColourOf(ClassOf(solution, link)), 1.0F,
                     {SelectionKind::kLink, static_cast<std::int64_t>(i)});
    }
  }
};

}  // namespace

std::unique_ptr<Overlay> MakeLinkOverlay() { return std::make_unique<LinkOverlay>(); }

}  // namespace penumbra::viewer
