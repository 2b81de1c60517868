// display/viewer/irradiance_graph.h
//
// Graphs of irradiance (thesis B.4.7): surfaces whose height above the triangles of the mesh is the
// irradiance.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "display/viewer/snapshot.h"
#include "display/viewer/view_state.h"
#include "solver/base/progress.h"

namespace penumbra::viewer {

// Irradiance values at the points of a grid on a triangle, with `cells` cells per side. The grid points have
// the barycentric coordinates (s, t) = (i, j) / cells, with 0 <= j <= cells and 0 <= i <= cells - j. Grid
// points are stored row by row, with constant j in a row.
struct GraphSheet {
  std::uint32_t triangle = 0;
  int cells = 1;
  std::vector<Rgb> exact;  // exact irradiance [W/m^2]; empty if only the interpolant is needed

  static std::size_t Size(int cells) {
    return static_cast<std::size_t>(cells + 1) * static_cast<std::size_t>(cells + 2) / 2;
  }
};
using IrradianceGraph = std::vector<GraphSheet>;

struct GraphOptions {
  int density = 1;  // largest number of grid cells per side of a triangle
  // If true, a triangle that fills a small part of its quadtree leaf has fewer grid cells than `density` per
  // side.
  bool dynamic = false;
  bool exact = false;  // if true, exact irradiances are also computed, which takes time
};

// Computes the irradiance graph over each triangle of the list `triangles`.
IrradianceGraph MakeGraph(const LightState& light, const IrradianceMesh& mesh,
                          std::span<const std::uint32_t> triangles, const GraphOptions& options,
                          const ExecutionContext& context);

}  // namespace penumbra::viewer
