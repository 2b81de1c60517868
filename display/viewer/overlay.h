// display/viewer/overlay.h
//
// Visualisations of the solver's inside (thesis B.4). A new one is a class and a line in AllOverlays().

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "display/viewer/error_map.h"
#include "display/viewer/irradiance_graph.h"
#include "display/viewer/overlay_drawing.h"
#include "display/viewer/probes.h"
#include "display/viewer/snapshot.h"
#include "display/viewer/view_state.h"
#include "mesh/pipeline/discontinuity_list.h"

namespace penumbra::viewer {

// What takes long to compute, as far as it is there.
struct AnalysisResults {
  std::shared_ptr<const DiscontinuityList> discontinuities;
  std::shared_ptr<const IrradianceGraph> graph;
  std::shared_ptr<const ErrorMap> error_map;
  std::shared_ptr<const ProbeResult> probe;
  std::shared_ptr<const std::vector<BackprojectedPatch>> backprojection;

  bool operator==(const AnalysisResults&) const = default;
};

struct OverlayContext {
  const Snapshot& snapshot;
  const MeshState& mesh;  // whose triangles the tools speak of
  const OverlaySettings& settings;
  const Selection& selection;
  const AnalysisResults& results;
  bool isolated = false;  // nothing but what is selected is drawn

  bool Isolates(SelectionKind kind) const { return isolated && selection.kind == kind; }
};

class Overlay {
 public:
  virtual ~Overlay() = default;
  // Adds what there is to see. Draws nothing unless it is switched on.
  virtual void Draw(const OverlayContext& context, OverlayDrawing* drawing) const = 0;
};

// In the order of painting.
std::span<const std::unique_ptr<Overlay>> AllOverlays();

std::unique_ptr<Overlay> MakeElementMeshOverlay();
std::unique_ptr<Overlay> MakeTriangulationOverlay();
std::unique_ptr<Overlay> MakeDiscontinuityOverlay();
std::unique_ptr<Overlay> MakeLinkOverlay();
std::unique_ptr<Overlay> MakeSamplePointOverlay();
std::unique_ptr<Overlay> MakeGraphOverlay();
std::unique_ptr<Overlay> MakeBackprojectionOverlay();
std::unique_ptr<Overlay> MakeProbeOverlay();
std::unique_ptr<Overlay> MakeSelectionOverlay();

}  // namespace penumbra::viewer
