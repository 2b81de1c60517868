// display/viewer/overlay.h
//
// Overlays: visualisations of the solver's internal data, drawn over the picture (thesis B.4).

#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "display/viewer/error_map.h"
#include "display/viewer/irradiance_graph.h"
#include "display/viewer/line_plot.h"
#include "display/viewer/overlay_drawing.h"
#include "display/viewer/probes.h"
#include "display/viewer/snapshot.h"
#include "display/viewer/view_state.h"
#include "mesh/pipeline/discontinuity_list.h"
#include "solver/base/registry.h"

namespace penumbra::viewer {

class Menu;
class Settings;

// Results of analyses that take a long time to compute. Each pointer in AnalysisResults is null until the
// result is complete.
struct AnalysisResults {
  std::shared_ptr<const DiscontinuityList> discontinuities;
  std::shared_ptr<const IrradianceGraph> graph;
  std::shared_ptr<const ErrorMap> error_map;
  std::shared_ptr<const ProbeResult> probe;
  std::shared_ptr<const std::vector<BackprojectedPatch>> backprojection;
  std::shared_ptr<const LinePlot> line_plot;

  bool operator==(const AnalysisResults&) const = default;
};

struct OverlayContext {
  const Snapshot& snapshot;
  const MeshState& mesh;  // the mesh whose triangles selection, graphs and probes use
  const OverlaySettings& settings;
  const Selection& selection;
  const AnalysisResults& results;
  bool isolated = false;  // true if the picture shows only the selected object

  bool Isolates(SelectionKind kind) const { return isolated && selection.kind == kind; }
};

// The results that must be computed before an overlay can be drawn.
struct OverlayNeeds {
  // True if the overlay needs the triangles of a mesh, even in drawing modes that show no mesh.
  bool triangles = false;
  bool discontinuities = false;  // the list of all discontinuities of the irradiance
  bool graph = false;            // the graph of the irradiance over the selected object
  bool exact_graph = false;      // the graph of the exact irradiance over the selected object
};

// A part of an overlay that the user can switch on and off.
struct OverlaySwitch {
  std::string name;  // name of the switch, as in the script line `set NAME on`
  std::string help;  // label of the switch in panels, in a few words
  std::string menu;  // name of the switch's item in the menu `Visualisation`
  std::string key;   // a key chord such as `ctrl+s`, or empty
  OverlayNeeds needs;
};

// The names of the panels that contain switches and settings of overlays.
inline constexpr std::string_view kOverlayGroups[] = {"Visualisations", "Links", "Graphs"};

class Overlay {
 public:
  virtual ~Overlay() = default;

  // The name of the panel (entry of kOverlayGroups) that contains the overlay's switches and settings.
  virtual std::string Group() const { return "Visualisations"; }
  // The switches that turn parts of the overlay on and off. An overlay without switches shows the object that
  // the user has selected, or the point that the user has probed.
  virtual std::vector<OverlaySwitch> Switches() const { return {}; }
  // Adds those settings of the overlay to `settings` that are not switches. REQUIRES: `values` outlives
  // `settings`.
  virtual void AddSettings(OverlaySettings* /*values*/, Settings* /*settings*/) const {}
  // Adds those menu items of the overlay to `menu` that are not switches. REQUIRES: `values` outlives `menu`.
  virtual void AddMenuItems(OverlaySettings* /*values*/, Menu* /*menu*/) const {}

  // The number of the overlay's layer. Overlays are drawn in ascending order of their layers, and within a
  // layer in the order of the registry Overlays(). The built-in overlays have layers 0 to 8.
  virtual int Layer() const { return kTopLayer; }
  // Adds those parts of the overlay that are switched on to `drawing`.
  virtual void Draw(const OverlayContext& context, OverlayDrawing* drawing) const = 0;

 protected:
  static constexpr int kTopLayer = 100;
};

// The type of the registry Overlays(), which lists all overlays.
using OverlayRegistry = Registry<const Overlay>;

}  // namespace penumbra::viewer
