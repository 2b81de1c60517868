#include "display/viewer/triangulation_overlay.h"

#include <algorithm>
#include <tuple>

#include "display/viewer/mesh_tools.h"

namespace penumbra::viewer {
namespace {

class TriangulationOverlay final : public Overlay {
 public:
  std::vector<OverlaySwitch> Switches() const override {
    return {{std::string(kTrianglesSwitch), "Triangulation", "Triangles", "t", {.triangles = true}}};
  }
  int Layer() const override { return 1; }
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    if (!context.settings.Shows(kTrianglesSwitch)) return;
    const IrradianceMesh& mesh = context.mesh.mesh();
    std::vector<std::uint32_t> shown;
    if (context.selection.kind == SelectionKind::kElement && context.snapshot.light) {
      const auto top = static_cast<ElementId>(context.selection.index);
      shown = TrianglesOf(*context.snapshot.light, mesh, {&top, 1});
    } else if (context.Isolates(SelectionKind::kTriangle)) {
      shown.push_back(static_cast<std::uint32_t>(context.selection.index));
    } else {
      for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) shown.push_back(i);
    }
    // Each edge once; violet if either triangle says so.
    using Edge = std::tuple<std::uint32_t, std::uint32_t, bool, std::uint32_t>;
    std::vector<Edge> edges;
    for (const std::uint32_t i : shown)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& t = mesh.triangles[i];
        const auto [a, b] = std::minmax(t.vertex[k], t.vertex[(k + 1) % 3]);
        edges.emplace_back(a, b, !t.discontinuity[k], i);
      }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end(),
                            [](const Edge& x, const Edge& y) {
                              return std::get<0>(x) == std::get<0>(y) && std::get<1>(x) == std::get<1>(y);
                            }),
                edges.end());
    // Green first, so that violet lies on top where they meet.
    for (const bool violet : {false, true})
      for (const auto& [a, b, plain, triangle] : edges)
        if (plain != violet)
          drawing->Line(mesh.positions[a], mesh.positions[b], violet ? colour::kViolet : colour::kGreen,
                        1.0F);
  }
};

}  // namespace

OverlayRegistry::Method TriangulationOverlayMethod() {
  return {"triangulation", "the triangles of the irradiance mesh, discontinuity edges violet", {}, [] {
            return std::make_unique<const TriangulationOverlay>();
          }};
}

}  // namespace penumbra::viewer
