#include "display/viewer/element_mesh_overlay.h"

#include <algorithm>

#include "display/viewer/menu.h"
#include "display/viewer/mesh_tools.h"
#include "display/viewer/settings.h"

namespace penumbra::viewer {
namespace {

// One level less deep than all is no deeper than this: deeper elements are too small to be seen.
constexpr int kDeepestSeen = 8;

class ElementMeshOverlay final : public Overlay {
 public:
  std::vector<OverlaySwitch> Switches() const override {
    return {{"element-mesh", "Element mesh", "Element mesh", "m", {}}};
  }
  void AddSettings(OverlaySettings* values, Settings* settings) const override {
    settings->Integer("mesh-depth", Group(), "Mesh depth", &values->mesh_depth, 0, kMaxLevel);
  }
  void AddMenuItems(OverlaySettings* values, Menu* menu) const override {
    int& depth = values->mesh_depth;
    menu->Add({"Visualisation/Mesh one level deeper",
               ".",
               "Mesh depth",
               [&depth] { depth = std::min(depth + 1, kMaxLevel); },
               {}});
    menu->Add({"Visualisation/Mesh one level less deep",
               ",",
               "Mesh depth",
               [&depth] { depth = std::max(std::min(depth, kDeepestSeen) - 1, 0); },
               {}});
  }
  int Layer() const override { return 0; }
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    if (!context.settings.Shows("element-mesh")) return;
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

OverlayRegistry::Method ElementMeshOverlayMethod() {
  return {"element-mesh", "the elements of the solution, down to a level", {"mesh-depth"}, [] {
            return std::make_unique<const ElementMeshOverlay>();
          }};
}

}  // namespace penumbra::viewer
