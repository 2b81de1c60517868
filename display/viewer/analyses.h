// display/viewer/analyses.h
//
// What overlays need and what takes long to compute, worked out beside the view for what it shows at the
// time.

#pragma once

#include <memory>
#include <vector>

#include "display/viewer/deferred.h"
#include "display/viewer/overlay.h"

namespace penumbra::viewer {

class Analyses {
 public:
  Analyses();

  // What the view asks for, as far as it is there; starts what is not. `tools` is the mesh of the tools.
  AnalysisResults Update(const Snapshot& snapshot, const std::shared_ptr<const MeshState>& tools,
                         const ViewState& view);
  // Whether anything is under way.
  bool Busy();
  // There was not enough memory for one since this was asked last: it stays out.
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

  Deferred<Light, DiscontinuityList> discontinuities_;
  Deferred<GraphKey, IrradianceGraph> graph_;
  Deferred<MeshKey, ErrorMap> error_map_;
  Deferred<PointKey, ProbeResult> probe_;
  Deferred<PointKey, std::vector<BackprojectedPatch>> backprojection_;
};

}  // namespace penumbra::viewer
