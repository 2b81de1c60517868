#include "display/viewer/overlay.h"

namespace penumbra::viewer {

std::span<const std::unique_ptr<Overlay>> AllOverlays() {
  static const std::vector<std::unique_ptr<Overlay>> overlays = [] {
    std::vector<std::unique_ptr<Overlay>> all;
    all.push_back(MakeElementMeshOverlay());
    all.push_back(MakeTriangulationOverlay());
    all.push_back(MakeDiscontinuityOverlay());
    all.push_back(MakeLinkOverlay());
    all.push_back(MakeSamplePointOverlay());
    all.push_back(MakeGraphOverlay());
    all.push_back(MakeBackprojectionOverlay());
    all.push_back(MakeProbeOverlay());
    all.push_back(MakeSelectionOverlay());
    return all;
  }();
  return overlays;
}

}  // namespace penumbra::viewer
