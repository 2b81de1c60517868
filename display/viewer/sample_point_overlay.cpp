#include "display/viewer/sample_point_overlay.h"

#include "display/viewer/mesh_tools.h"

namespace penumbra::viewer {
namespace {

class SamplePointOverlay final : public Overlay {
 public:
  std::vector<OverlaySwitch> Switches() const override {
    return {{"sample-points", "Sample points", "Sample points", "s", {.triangles = true}}};
  }
  int Layer() const override { return 4; }
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    if (!context.settings.Shows("sample-points")) return;
    const IrradianceMesh& mesh = context.mesh.mesh();
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      if (!Selected(context, i)) continue;
      const Vec3 up = context.settings.graph_scale * NormalOf(*context.snapshot.scene, mesh, i);
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

OverlayRegistry::Method SamplePointOverlayMethod() {
  return {"sample-points", "the samples of the interpolants", {}, [] {
            return std::make_unique<const SamplePointOverlay>();
          }};
}

}  // namespace penumbra::viewer
