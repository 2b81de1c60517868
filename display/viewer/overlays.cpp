#include "display/viewer/overlays.h"

#include <algorithm>

#include "display/viewer/backprojection_overlay.h"
#include "display/viewer/discontinuity_overlay.h"
#include "display/viewer/element_mesh_overlay.h"
#include "display/viewer/graph_overlay.h"
#include "display/viewer/line_overlay.h"
#include "display/viewer/link_overlay.h"
#include "display/viewer/probe_overlay.h"
#include "display/viewer/sample_point_overlay.h"
#include "display/viewer/selection_overlay.h"
#include "display/viewer/settings.h"
#include "display/viewer/triangulation_overlay.h"

namespace penumbra::viewer {

OverlayRegistry& Overlays() {
  static OverlayRegistry registry(
      "overlay",
      {ElementMeshOverlayMethod(), LinkOverlayMethod(), DiscontinuityOverlayMethod(),
       TriangulationOverlayMethod(), SamplePointOverlayMethod(), GraphOverlayMethod(),
       BackprojectionOverlayMethod(), ProbeOverlayMethod(), LineOverlayMethod(), SelectionOverlayMethod()});
  return registry;
}

std::vector<std::unique_ptr<const Overlay>> MakeOverlays() {
  std::vector<std::unique_ptr<const Overlay>> overlays;
  for (const OverlayRegistry::Method& method : Overlays().methods()) overlays.push_back(method.make());
  return overlays;
}

OverlayNeeds NeedsOf(const OverlaySettings& settings) {
  OverlayNeeds all;
  for (const auto& overlay : MakeOverlays())
    for (const OverlaySwitch& part : overlay->Switches()) {
      if (!settings.Shows(part.name)) continue;
      all.triangles |= part.needs.triangles;
      all.discontinuities |= part.needs.discontinuities;
      all.graph |= part.needs.graph;
      all.exact_graph |= part.needs.exact_graph;
    }
  return all;
}

OverlayDrawing DrawOverlays(const OverlayContext& context) {
  std::vector<std::unique_ptr<const Overlay>> overlays = MakeOverlays();
  std::stable_sort(overlays.begin(), overlays.end(),
                   [](const auto& a, const auto& b) { return a->Layer() < b->Layer(); });
  OverlayDrawing drawing;
  for (const auto& overlay : overlays) overlay->Draw(context, &drawing);
  return drawing;
}

void AddOverlaySettings(std::string_view group, OverlaySettings* values, Settings* settings) {
  for (const auto& overlay : MakeOverlays()) {
    if (overlay->Group() != group) continue;
    for (const OverlaySwitch& part : overlay->Switches())
      settings->Toggle(
          part.name, overlay->Group(), part.help, [values, name = part.name] { return values->Shows(name); },
          [values, name = part.name](bool on) {
            if (on)
              values->shown.insert(name);
            else
              values->shown.erase(name);
          });
    overlay->AddSettings(values, settings);
  }
}

}  // namespace penumbra::viewer
