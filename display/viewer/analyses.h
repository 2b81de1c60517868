// display/viewer/analyses.h
//
// Computes in the background those analysis results (error maps, probes, graphs and others) that the present
// view needs and that take a long time.

#pragma once

#include <memory>
#include <vector>

#include "display/viewer/deferred.h"
#include "display/viewer/overlay.h"

namespace penumbra::viewer {

class Analyses {
 public:
  Analyses();

  // Returns those results that the view needs and that are complete, and starts the computation of missing
  // results. `tools` is the mesh on which the user's tools (selection, graphs, probes) work.
  AnalysisResults Update(const Snapshot& snapshot, const std::shared_ptr<const MeshState>& tools,
                         const ViewState& view);
  // True if the computation of an analysis is running.
  bool Busy();
  // True if the computation of an analysis has run out of memory since the last call of RanOutOfMemory(). A
  // computation that has run out of memory has no result.
  bool RanOutOfMemory();

 private:
  using Light = std::shared_ptr<const LightState>;
  using Mesh = std::shared_ptr<const MeshState>;
  struct MeshKey {
    Light light;
    Mesh mesh;
    bool operator==(const MeshKey&) const = default;
  };
  struct GraphKey {
    Light light;
    Mesh mesh;
    Selection selection;
    int density = 0;
    bool dynamic = false, exact = false;
    bool operator==(const GraphKey&) const = default;
  };
  struct PointKey {
    Light light;
    Mesh mesh;
    ProbedPoint at;
    bool operator==(const PointKey&) const = default;
  };

  struct LineKey {
    Light light;
    Mesh mesh;
    PlotLine line;
    bool operator==(const LineKey&) const = default;
  };

  Deferred<Light, DiscontinuityList> discontinuities_;
  Deferred<GraphKey, IrradianceGraph> graph_;
  Deferred<MeshKey, ErrorMap> error_map_;
  Deferred<PointKey, ProbeResult> probe_;
  Deferred<PointKey, std::vector<BackprojectedPatch>> backprojection_;
  Deferred<LineKey, LinePlot> line_plot_;
};

}  // namespace penumbra::viewer
