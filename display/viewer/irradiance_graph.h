// display/viewer/irradiance_graph.h
//
// The surfaces of thesis B.4.7: irradiance as height above the triangles.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "display/viewer/snapshot.h"
#include "display/viewer/view_state.h"
#include "solver/base/progress.h"

namespace penumbra::viewer {

// Values on the grid of a triangle with `cells` along each side: row j = 0 .. cells holds i = 0 .. cells - j,
// at (s, t) = (i, j) / cells.
struct GraphSheet {
  std::uint32_t triangle = 0;
  int cells = 1;
  std::vector<Rgb> exact;  // [W/m^2]; empty where only the interpolant was asked for

  static std::size_t Size(int cells) {
    return static_cast<std::size_t>(cells + 1) * static_cast<std::size_t>(cells + 2) / 2;
  }
};
using IrradianceGraph = std::vector<GraphSheet>;

struct GraphOptions {
  int density = 1;       // cells along each side of a triangle, at most
  bool dynamic = false;  // fewer where the triangle fills little of its leaf
  bool exact = false;    // with exact values, which cost time
};

// Sheets over triangles.
IrradianceGraph MakeGraph(const LightState& light, const IrradianceMesh& mesh,
                          std::span<const std::uint32_t> triangles, const GraphOptions& options,
                          const ExecutionContext& context);

}  // namespace penumbra::viewer
