#include "display/viewer/analyses.h"

#include <algorithm>
#include <iterator>

#include "display/viewer/mesh_tools.h"
#include "display/viewer/overlays.h"

namespace penumbra::viewer {

Analyses::Analyses()
    : discontinuities_([](const Light& light, const ExecutionContext& context) {
        DiscontinuityOptions whatever_they_weigh = light->discontinuities();  // thesis B.4.4
        whatever_they_weigh.min_weight = 0;
        return ListDiscontinuities(light->solution(), light->visibility(), whatever_they_weigh, context);
      }),
      graph_([](const GraphKey& key, const ExecutionContext& context) {
        std::vector<std::uint32_t> triangles;
        if (key.selection.kind == SelectionKind::kTriangle) {
          triangles.push_back(static_cast<std::uint32_t>(key.selection.index));
        } else {
          const auto top = static_cast<ElementId>(key.selection.index);
          triangles = TrianglesOf(*key.light, key.mesh->mesh(), {&top, 1});
        }
        return MakeGraph(*key.light, key.mesh->mesh(), triangles, {key.density, key.dynamic, key.exact},
                         context);
      }),
      error_map_([](const MeshKey& key, const ExecutionContext& context) {
        return MapRepresentationError(*key.light, key.mesh->mesh(), context);
      }),
      probe_([](const PointKey& key, const ExecutionContext&) {
        return ProbeIrradiance(*key.light, key.mesh.get(), key.at);
      }),
      backprojection_([](const PointKey& key, const ExecutionContext& context) {
        return Backproject(*key.light, key.at, context);
      }),
      line_plot_([](const LineKey& key, const ExecutionContext& context) {
        return PlotAlong(*key.light, key.mesh.get(), key.line, context);
      }) {}

AnalysisResults Analyses::Update(const Snapshot& snapshot, const std::shared_ptr<const MeshState>& tools,
                                 const ViewState& view) {
  AnalysisResults results;
  if (!snapshot.light) return results;
  const OverlaySettings& overlays = view.overlays;
  const OverlayNeeds needs = NeedsOf(overlays);
  if (needs.discontinuities || view.selection.kind == SelectionKind::kDiscontinuity)
    results.discontinuities = discontinuities_.Get(snapshot.light);
  if (needs.graph &&
      (view.selection.kind == SelectionKind::kElement || view.selection.kind == SelectionKind::kTriangle))
    results.graph = graph_.Get({snapshot.light, tools, view.selection, overlays.grid_density,
                                overlays.dynamic_grid, needs.exact_graph});
  const std::shared_ptr<const MeshState>& interpolants = snapshot.Mesh(MeshKind::kInterpolant);
  if (view.error_map && interpolants) results.error_map = error_map_.Get({snapshot.light, interpolants});
  if (view.probe) results.probe = probe_.Get({snapshot.light, interpolants, *view.probe});
  if (view.backprojection)
    results.backprojection = backprojection_.Get({snapshot.light, nullptr, *view.backprojection});
  if (view.line) results.line_plot = line_plot_.Get({snapshot.light, interpolants, *view.line});
  return results;
}

bool Analyses::Busy() {
  // All are asked: what is done has to be collected.
  const bool busy[] = {discontinuities_.Busy(), graph_.Busy(),          error_map_.Busy(),
                       probe_.Busy(),           backprojection_.Busy(), line_plot_.Busy()};
  return std::find(std::begin(busy), std::end(busy), true) != std::end(busy);
}

bool Analyses::RanOutOfMemory() {
  const bool failed[] = {discontinuities_.RanOutOfMemory(), graph_.RanOutOfMemory(),
                         error_map_.RanOutOfMemory(),       probe_.RanOutOfMemory(),
                         backprojection_.RanOutOfMemory(),  line_plot_.RanOutOfMemory()};
  return std::find(std::begin(failed), std::end(failed), true) != std::end(failed);
}

}  // namespace penumbra::viewer
