// Objects, materials and faces by their names: selecting, hiding and framing them.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "display/glm_conversion.h"
#include "display/viewer/selection.h"
#include "display/viewer/viewer.h"
#include "solver/base/check.h"

namespace penumbra::viewer {
namespace {

std::string PartText(const Scene& scene, const Selection& selection) {
  const auto index = static_cast<std::size_t>(std::max<std::int64_t>(selection.index, 0));
  if (selection.kind == SelectionKind::kObject && index < scene.objects.size())
    return "object:" + scene.objects[index].name;
  if (selection.kind == SelectionKind::kMaterial && index < scene.materials.size())
    return "material:" + scene.materials[index].name;
  return "none";
}

template <class Part>
std::int64_t IndexOf(const std::vector<Part>& parts, const std::string& name, const char* what) {
  const auto found = std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.name == name; });
  if (found == parts.end()) throw InputError(fmt::format("the scene has no {} '{}'", what, name));
  return found - parts.begin();
}

}  // namespace

// `object:NAME`, `material:NAME`, `face:NUMBER` or `none`.
void Viewer::SelectPart(const std::string& text) {
  const Scene& scene = *snapshot_->scene;
  const std::string kind = text.substr(0, text.find(':'));
  const std::string name = text.size() > kind.size() ? text.substr(kind.size() + 1) : "";
  if (text == "none") {
    view_.selection = {};
  } else if (kind == "object") {
    view_.selection = {SelectionKind::kObject, IndexOf(scene.objects, name, "object")};
  } else if (kind == "material") {
    view_.selection = {SelectionKind::kMaterial, IndexOf(scene.materials, name, "material")};
  } else if (kind == "face") {
    std::int32_t face = -1;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), face);
    const bool number = error == std::errc() && end == name.data() + name.size();
    for (std::size_t p = 0; number && p < scene.patches.size(); ++p)
      if (std::count(scene.patches[p].faces.begin(), scene.patches[p].faces.end(), face) > 0)
        return SelectPatch(static_cast<PatchId>(p));
    throw InputError(fmt::format("the scene has no face '{}'", name));
  } else {
    throw InputError(fmt::format("'{}' is none of object:NAME, material:NAME, face:NUMBER, none", text));
  }
}

void Viewer::SelectPatch(PatchId patch) {
  view_.selection = {SelectionKind::kElement, ElementForest::Root(patch)};
}

std::set<std::int32_t> Viewer::SelectedObjects() const {
  std::set<std::int32_t> objects;
  for (const ElementId element : SelectedElements(Context())) {
    const PatchId patch =
        snapshot_->light ? snapshot_->light->solution().forest[element].patch : static_cast<PatchId>(element);
    objects.insert(snapshot_->scene->patches[static_cast<std::size_t>(patch)].object);
  }
  return objects;
}

// Looks at the selection, or at the whole scene if nothing is selected, from where the camera looks, at a
// distance from which all of it is seen.
void Viewer::FrameSelection() {
  const Scene& scene = *snapshot_->scene;
  Vec3 low = scene.Bounds().first, high = scene.Bounds().second;
  const std::vector<ElementId> elements = SelectedElements(Context());
  if (!elements.empty()) {
    low = Vec3::Constant(INFINITY);
    high = -low;
    for (const ElementId element : elements) {
      const std::span<const Vec3> corners = snapshot_->light
                                                ? snapshot_->light->solution().forest[element].Vertices()
                                                : scene.patches[static_cast<std::size_t>(element)].Vertices();
      for (const Vec3& v : corners) {
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
      }
    }
  }
  constexpr double kRoom = 1.2;  // around what is framed
  const double radius = 0.5 * kRoom * std::max((high - low).norm(), 1e-6);
  Camera camera = view_.camera;
  const Vec3 direction = (camera.look_at - camera.eye).normalized();
  const double half_fov = 0.5 * camera.vertical_fov * std::numbers::pi / 180;
  camera.look_at = 0.5 * (low + high);
  camera.eye = camera.look_at - radius / std::sin(half_fov) * direction;
  GoTo(camera);
}

void Viewer::AddPartSettings() {
  Setting part{"select", "Visualisations", "Selected part", SettingKind::kText, 0, 1, false, false, {}, {},
               {}};
  part.get = [this] { return PartText(*snapshot_->scene, view_.selection); };
  part.set = [this](const std::string& text) { SelectPart(text); };
  settings_.Add(std::move(part));
}

void Viewer::AddPartMenu() {
  Item("Geometry/Frame", "home", "Look at the selection, or at all of the scene",
       [this] { FrameSelection(); });
  Item("Geometry/Hide", "alt+h", "Do not draw the objects of the selection", [this] {
    for (const std::int32_t object : SelectedObjects()) view_.hidden.insert(object);
    view_.selection = {};
  });
  Item("Geometry/Show all", "alt+shift+h", "Draw every object", [this] {
    view_.hidden.clear();
    view_.isolate = false;
  });
  ToggleItem("Geometry/Outline", "ctrl+j", "outline");
}

}  // namespace penumbra::viewer
