// The elements of the global solution, down to a level (thesis B.4.2).

#include "display/viewer/mesh_tools.h"
#include "display/viewer/overlay.h"

namespace penumbra::viewer {
namespace {

class ElementMeshOverlay final : public Overlay {
 public:
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    if (!context.settings.element_mesh) return;
    if (!context.snapshot.light) {
      for (const Patch& patch : context.snapshot.scene->patches)
        drawing->Outline(patch.Vertices(), colour::kGrey);
      return;
    }
    const ElementForest& forest = context.snapshot.light->solution().forest;
    const bool one = context.selection.kind == SelectionKind::kElement;
    const auto top = static_cast<ElementId>(context.selection.index);
    for (std::size_t i = 0; i < forest.size(); ++i) {
      const Element& element = forest.elements()[i];
      // What is drawn to a depth are the elements there, and the leaves above.
      const bool shown = element.level == context.settings.mesh_depth ||
                         (element.level < context.settings.mesh_depth && element.IsLeaf());
      if (shown && (!one || IsBelow(forest, static_cast<ElementId>(i), top)))
        drawing->Outline(element.Vertices(), colour::kGrey, 1.0F);
    }
  }
};

}  // namespace

std::unique_ptr<Overlay> MakeElementMeshOverlay() { return std::make_unique<ElementMeshOverlay>(); }

}  // namespace penumbra::viewer
