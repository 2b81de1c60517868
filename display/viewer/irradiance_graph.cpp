#include "display/viewer/irradiance_graph.h"

#include <algorithm>
#include <cmath>

#include "display/viewer/mesh_tools.h"
#include "solver/base/parallel.h"

namespace penumbra::viewer {

IrradianceGraph MakeGraph(const LightState& light, const IrradianceMesh& mesh,
                          std::span<const std::uint32_t> triangles, const GraphOptions& options,
                          const ExecutionContext& context) {
  const ElementForest& forest = light.solution().forest;
  IrradianceGraph graph(triangles.size());
  ParallelFor(graph.size(), 1, [&](std::size_t k) {
    if (context.Cancelled()) return;
    GraphSheet& sheet = graph[k];
    sheet.triangle = triangles[k];
    sheet.cells = options.density;
    if (options.dynamic) {
      const double share =
          TriangleArea(mesh, sheet.triangle) / forest[LeafOf(light, mesh, sheet.triangle)].area;
      sheet.cells =
          std::max(1, static_cast<int>(std::lround(options.density * std::sqrt(std::min(share, 1.0)))));
    }
    if (!options.exact) return;
    sheet.exact.reserve(GraphSheet::Size(sheet.cells));
    for (int j = 0; j <= sheet.cells; ++j)
      for (int i = 0; i <= sheet.cells - j; ++i)
        sheet.exact.push_back(ExactInTriangle(light, mesh, sheet.triangle,
                                              static_cast<double>(i) / sheet.cells,
                                              static_cast<double>(j) / sheet.cells));
  });
  return graph;
}

}  // namespace penumbra::viewer
