// display/viewer/overlay.h
//
// Visualisations of the solver's inside (thesis B.4).

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

// What has to be computed for an overlay.
struct OverlayNeeds {
  bool triangles = false;        // of a mesh, where the drawing mode has none
  bool discontinuities = false;  // all of them
  bool graph = false;            // of the irradiance over what is selected
  bool exact_graph = false;      // that of the exact irradiance, too
};

// Something that users switch on and off.
struct OverlaySwitch {
  std::string name;  // as in `set NAME on`
  std::string help;  // a few words: what panels call it
  std::string menu;  // its item in the menu `Visualisation`
  std::string key;   // a chord, or empty
  OverlayNeeds needs;
};

// The groups of panels that overlays may stand in.
inline constexpr std::string_view kOverlayGroups[] = {"Visualisations", "Links", "Graphs"};

class Overlay {
 public:
  virtual ~Overlay() = default;

  // The one of kOverlayGroups that its switches and settings stand in.
  virtual std::string Group() const { return "Visualisations"; }
  // Without switches, an overlay shows what a user selects or probes.
  virtual std::vector<OverlaySwitch> Switches() const { return {}; }
  // Adds what can be set beside the switches. The values outlive the settings.
  virtual void AddSettings(OverlaySettings* /*values*/, Settings* /*settings*/) const {}
  // Adds what the menu has beside the switches. The values outlive the menu.
  virtual void AddMenuItems(OverlaySettings* /*values*/, Menu* /*menu*/) const {}

  // Overlays are painted by layer, the lowest first; those of equal layer in the order of the registry. Those
  // of the library have the layers 0 to 8.
  virtual int Layer() const { return kTopLayer; }
  // Adds what there is to see. Draws nothing that is not switched on.
  virtual void Draw(const OverlayContext& context, OverlayDrawing* drawing) const = 0;

 protected:
  static constexpr int kTopLayer = 100;
};

// Overlays() holds all overlays.
using OverlayRegistry = Registry<const Overlay>;

}  // namespace penumbra::viewer
