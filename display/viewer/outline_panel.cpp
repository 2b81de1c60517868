// The outline: objects with their faces, and materials, as a tree that can be searched.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>

#include "display/viewer/panels.h"

namespace penumbra::viewer {
namespace {

std::string LowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool Matches(const std::string& name, const char* search) {
  return LowerCase(name).find(LowerCase(search)) != std::string::npos;
}

// The object and the face that the selection lies in; -1: none.
struct OutlinePlace {
  std::int64_t object = -1, face = -1, material = -1;
};

OutlinePlace PlaceOfSelection(const Viewer& viewer) {
  OutlinePlace place;
  const Selection& selection = viewer.view().selection;
  if (selection.kind == SelectionKind::kObject) place.object = selection.index;
  if (selection.kind == SelectionKind::kMaterial) place.material = selection.index;
  if (selection.kind != SelectionKind::kElement) return place;
  const Snapshot& now = viewer.snapshot();
  const auto element = static_cast<ElementId>(selection.index);
  const PatchId p = now.light ? now.light->solution().forest[element].patch : static_cast<PatchId>(element);
  const Patch& patch = now.scene->patches[static_cast<std::size_t>(p)];
  place.object = patch.object;
  if (!patch.faces.empty()) place.face = patch.faces[0];
  return place;
}

}  // namespace

void Panels::OutlineObject(Viewer& viewer, std::size_t object, std::int64_t selected_object,
                           std::int64_t selected_face) {
  const Object& part = viewer.snapshot().scene->objects[object];
  const bool selected = selected_object == static_cast<std::int64_t>(object);
  const bool hidden = viewer.view().hidden.contains(static_cast<std::int32_t>(object));
  const std::string label = fmt::format("{}{}##{}", part.name, hidden ? " (hidden)" : "", object);
  const bool open = ImGui::TreeNodeEx(
      label.c_str(), ImGuiTreeNodeFlags_OpenOnArrow | (selected ? ImGuiTreeNodeFlags_Selected : 0));
  if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen())
    Change(viewer, "select", "object:" + part.name, false);
  if (!open) return;
  for (const std::int32_t face : part.faces)
    if (ImGui::Selectable(fmt::format("face {}", face).c_str(), face == selected_face))
      Change(viewer, "select", fmt::format("face:{}", face), false);
  ImGui::TreePop();
}

void Panels::Outline(Viewer& viewer) {
  if (!viewer.panels().outline) return;
  // The scene of this frame: a click may not change it under the loop.
  const std::shared_ptr<const Scene> scene = viewer.snapshot().scene;
  if (BeginPanel("Outline", {8, 60, 260, 420}, &viewer.panels().outline)) {
    ImGui::InputText("search", search_, sizeof search_);
    for (const auto& [label, menu] :
         {std::pair("Frame", "Geometry/Frame"), std::pair("Hide", "Geometry/Hide"),
          std::pair("Only this", "Geometry/Draw only what is selected"),
          std::pair("Show all", "Geometry/Show all")}) {
      if (ImGui::SmallButton(label)) Run(viewer, menu);
      ImGui::SameLine();
    }
    ImGui::NewLine();
    const OutlinePlace selected = PlaceOfSelection(viewer);
    if (ImGui::CollapsingHeader("Objects", ImGuiTreeNodeFlags_DefaultOpen))
      for (std::size_t i = 0; i < scene->objects.size(); ++i)
        if (Matches(scene->objects[i].name, search_))
          OutlineObject(viewer, i, selected.object, selected.face);
    if (ImGui::CollapsingHeader("Materials", ImGuiTreeNodeFlags_DefaultOpen))
      for (std::size_t i = 0; i < scene->materials.size(); ++i) {
        const std::string& name = scene->materials[i].name;
        if (!Matches(name, search_)) continue;
        if (ImGui::Selectable(fmt::format("{}##m{}", name, i).c_str(),
                              selected.material == static_cast<std::int64_t>(i)))
          Change(viewer, "select", "material:" + name, false);
      }
  }
  ImGui::End();
}

}  // namespace penumbra::viewer
