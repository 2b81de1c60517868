// display/viewer/overlay.h
//
// Visualisations of the solver's internal data (thesis B.4).

#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "display/viewer/error_map.h"
#include "display/viewer/irradiance_graph.h"
#include "display/viewer/overlay_drawing.h"
#include "display/viewer/probes.h"
#include "display/viewer/snapshot.h"
#include "display/viewer/view_state.h"
#include "mesh/pipeline/discontinuity_list.h"
#include "solver/base/registry.h"

namespace penumbra::viewer {

class Menu;
class Settings;

// Results that take long to compute; null until complete.
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
  const MeshState& mesh;  // the mesh whose triangles the tools use
  const OverlaySettings& settings;
  const Selection& selection;
  const AnalysisResults& results;
  bool isolated = false;  // the picture shows only the selection

  bool Isolates(SelectionKind kind) const { return isolated && selection.kind == kind; }
};

// The computations that an overlay needs.
struct OverlayNeeds {
  bool triangles = false;        // triangles of a mesh, even if the drawing mode has none
  bool discontinuities = false;  // all discontinuities
  bool graph = false;            // the graph of the irradiance over the selection
  bool exact_graph = false;      // the graph of the exact irradiance as well
};

// A part of an overlay that users switch on and off.
struct OverlaySwitch {
  std::string name;  // as in `set NAME on`
  std::string help;  // a few words: the label in panels
  std::string menu;  // its item in the menu `Visualisation`
  std::string key;   // a chord, or empty
  OverlayNeeds needs;
};

// The groups of panels that contain overlays.
inline constexpr std::string_view kOverlayGroups[] = {"Visualisations", "Links", "Graphs"};

class Overlay {
 public:
  virtual ~Overlay() = default;

  // The group of kOverlayGroups that contains the overlay's switches and settings.
  virtual std::string Group() const { return "Visualisations"; }
  // An overlay without switches shows what a user selects or probes.
  virtual std::vector<OverlaySwitch> Switches() const { return {}; }
  // Adds settings other than the switches. `values` outlives `settings`.
  virtual void AddSettings(OverlaySettings* /*values*/, Settings* /*settings*/) const {}
  // Adds menu items other than the switches. `values` outlives `menu`.
  virtual void AddMenuItems(OverlaySettings* /*values*/, Menu* /*menu*/) const {}

  // The painter draws overlays in ascending order of layers, and in the registry's order within a layer. The
  // library's overlays have layers 0 to 8.
  virtual int Layer() const { return kTopLayer; }
  // Adds the overlay's visible parts to `drawing`. Parts that are switched off add nothing.
  virtual void Draw(const OverlayContext& context, OverlayDrawing* drawing) const = 0;

 protected:
  static constexpr int kTopLayer = 100;
};

// The type of Overlays().
using OverlayRegistry = Registry<const Overlay>;

}  // namespace penumbra::viewer
