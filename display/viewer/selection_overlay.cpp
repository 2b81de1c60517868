#include "display/viewer/selection_overlay.h"

#include "display/viewer/links.h"
#include "display/viewer/mesh_tools.h"
#include "display/viewer/selection.h"

namespace penumbra::viewer {
namespace {

class SelectionOverlay final : public Overlay {
 public:
  int Layer() const override { return 8; }
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    if (!context.selection || !IsValid(context, context.selection)) return;
    switch (context.selection.kind) {
      case SelectionKind::kNone:
        break;
      case SelectionKind::kElement:
      case SelectionKind::kObject:
      case SelectionKind::kMaterial:
        for (const ElementId element : SelectedElements(context))
          drawing->Outline(VerticesOf(context, element), colour::kYellow, 2.0F);
        break;
      case SelectionKind::kTriangle:
        drawing->Outline(
            TriangleVertices(context.mesh.mesh(), static_cast<std::uint32_t>(context.selection.index)),
            colour::kYellow, 2.0F);
        break;
      case SelectionKind::kLink:
      case SelectionKind::kTube:
        DrawLink(context, drawing);
        break;
      case SelectionKind::kDiscontinuity:
        DrawDiscontinuity(context, drawing);
        break;
    }
  }

 private:
  static std::span<const Vec3> VerticesOf(const OverlayContext& context, ElementId element) {
    if (context.snapshot.light) return context.snapshot.light->solution().forest[element].Vertices();
    return context.snapshot.scene->patches[static_cast<std::size_t>(element)].Vertices();
  }

  static void DrawLink(const OverlayContext& context, OverlayDrawing* drawing) {
    const RadiositySolution& solution = context.snapshot.light->solution();
    const Link& link = solution.links.links[static_cast<std::size_t>(context.selection.index)];
    const Element &receiver = solution.forest[link.receiver], &source = solution.forest[link.source];
    drawing->Outline(receiver.Vertices(), colour::kCyan, 2.0F);
    drawing->Outline(source.Vertices(), colour::kYellow, 2.0F);
    drawing->Arrow(Centroid(source.Vertices()), Centroid(receiver.Vertices()),
                   context.snapshot.scene->patches[static_cast<std::size_t>(receiver.patch)].normal,
                   ColourOf(ClassOf(solution, link)), 2.5F, {SelectionKind::kLink, context.selection.index});
    if (context.selection.kind != SelectionKind::kTube) return;
    for (const Vec3& a : source.Vertices())
      for (const Vec3& b : receiver.Vertices()) drawing->Line(a, b, colour::kGrey, 0.8F);
    for (const PatchId blocker : solution.links.Blockers(link)) {
      const auto vertices = context.snapshot.scene->patches[static_cast<std::size_t>(blocker)].Vertices();
      drawing->Fill(vertices, colour::kRed, 0.35F);
      drawing->Outline(vertices, colour::kRed, 1.6F);
    }
  }

  static void DrawDiscontinuity(const OverlayContext& context, OverlayDrawing* drawing) {
    const auto index = static_cast<std::size_t>(context.selection.index);
    const Discontinuity& d = context.results.discontinuities->all[index];
    const auto& ends = context.results.discontinuities->ends[index];
    const auto outline = [&](PatchId patch, Colour shown) {
      if (patch != kNoPatch)
        drawing->Outline(context.snapshot.scene->patches[static_cast<std::size_t>(patch)].Vertices(), shown,
                         2.0F);
    };
    outline(d.source, colour::kYellow);
    outline(d.blocker, colour::kRed);
    outline(d.receiver, colour::kCyan);
    drawing->Line(ends[0], ends[1], colour::kViolet, 3.0F);
  }
};

}  // namespace

OverlayRegistry::Method SelectionOverlayMethod() {
  return {"selection", "the outlines of what is selected", {}, [] {
            return std::make_unique<const SelectionOverlay>();
          }};
}

}  // namespace penumbra::viewer
