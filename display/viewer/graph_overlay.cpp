// Graphs of the irradiance over triangles: analytic white, interpolated blue, their difference red (thesis
// B.4.7); and the samples of the interpolants, yellow (B.4.8).

#include "display/viewer/mesh_tools.h"
#include "display/viewer/overlay.h"

namespace penumbra::viewer {
namespace {

Vec3 NormalOf(const OverlayContext& context, std::uint32_t triangle) {
  const PatchId patch = context.mesh.mesh().triangles[triangle].patch;
  return context.snapshot.scene->patches[static_cast<std::size_t>(patch)].normal;
}

class GraphOverlay final : public Overlay {
 public:
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    const OverlaySettings& settings = context.settings;
    if (!context.results.graph) return;
    for (const GraphSheet& sheet : *context.results.graph) {
      const auto shown = [&](std::size_t, double s, double t) {
        return context.mesh.mesh().irradiance[sheet.triangle].At(s, t).max(0.0).mean();
      };
      const auto exact = [&](std::size_t k, double, double) { return sheet.exact[k].mean(); };
      if (settings.interpolated_graph) DrawSheet(context, sheet, shown, colour::kBlue, drawing);
      if (sheet.exact.empty()) continue;
      if (settings.analytic_graph) DrawSheet(context, sheet, exact, colour::kWhite, drawing);
      if (settings.error_graph)
        DrawSheet(
            context, sheet,
            [&](std::size_t k, double s, double t) { return shown(k, s, t) - exact(k, s, t); }, colour::kRed,
            drawing);
    }
  }

 private:
  // The sheet as the lines of its grid, `height(k, s, t)` above each node [W/m^2].
  template <class Height>
  static void DrawSheet(const OverlayContext& context, const GraphSheet& sheet, const Height& height,
                        Colour shown, OverlayDrawing* drawing) {
    const Vec3 up = context.settings.graph_scale * NormalOf(context, sheet.triangle);
    const int n = sheet.cells;
    std::vector<Vec3> node;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n - j; ++i) {
        const double s = static_cast<double>(i) / n, t = static_cast<double>(j) / n;
        node.push_back(PointInTriangle(context.mesh.mesh(), sheet.triangle, s, t) +
                       height(node.size(), s, t) * up);
      }
    std::size_t k = 0;
    for (int j = 0; j < n; ++j) {
      const auto row = static_cast<std::size_t>(n - j + 1);
      for (int i = 0; i < n - j; ++i, ++k) {
        drawing->Line(node[k], node[k + 1], shown, 1.0F);
        drawing->Line(node[k], node[k + row], shown, 1.0F);
        drawing->Line(node[k + 1], node[k + row], shown, 1.0F);
      }
      ++k;
    }
  }
};

class SamplePointOverlay final : public Overlay {
 public:
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    if (!context.settings.sample_points) return;
    const IrradianceMesh& mesh = context.mesh.mesh();
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      if (!Selected(context, i)) continue;
      const Vec3 up = context.settings.graph_scale * NormalOf(context, i);
      for (const auto& [s, t] : kSampleAt) {
        const Vec3 at = PointInTriangle(mesh, i, s, t);
        drawing->points.push_back({at, colour::kYellow, 2.0F});
        // Values as heights only over what is selected: elsewhere they would be a forest.
        if (!context.selection) continue;
        const Vec3 top = at + mesh.irradiance[i].At(s, t).max(0.0).mean() * up;
        drawing->Line(at, top, colour::kYellow, 1.0F);
        drawing->points.push_back({top, colour::kYellow, 3.0F});
      }
    }
  }

 private:
  static bool Selected(const OverlayContext& context, std::uint32_t triangle) {
    const Selection& selection = context.selection;
    if (selection.kind == SelectionKind::kTriangle)
      return selection.index == static_cast<std::int64_t>(triangle);
    if (selection.kind != SelectionKind::kElement || !context.snapshot.light) return true;
    const LightState& light = *context.snapshot.light;
    const auto top = static_cast<ElementId>(selection.index);
    return context.mesh.mesh().triangles[triangle].patch == light.solution().forest[top].patch &&
           IsBelow(light.solution().forest, LeafOf(light, context.mesh.mesh(), triangle), top);
  }
};

}  // namespace

std::unique_ptr<Overlay> MakeGraphOverlay() { return std::make_unique<GraphOverlay>(); }
std::unique_ptr<Overlay> MakeSamplePointOverlay() { return std::make_unique<SamplePointOverlay>(); }

}  // namespace penumbra::viewer
