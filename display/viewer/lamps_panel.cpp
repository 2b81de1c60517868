// The panel of lamps and materials: dimmers, colours and switches, whose effect is seen while they move.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

#include "display/viewer/panels.h"
#include "solver/base/check.h"

namespace penumbra::viewer {
namespace {

// A dimmer goes up to this factor; scripts and fields may go further.
constexpr float kBrightest = 2;

Rgb FactorOf(const LightChange& change, const std::string& lamp) {
  for (const Dimming& dimming : change.lamps)
    if (dimming.name == lamp) return dimming.factor;
  return Rgb::Ones();
}

Rgb ReflectanceOf(const LightChange& change, const Material& material) {
  for (const Paint& paint : change.paints)
    if (paint.material == material.name) return paint.reflectance;
  return material.reflectance;
}

std::array<float, 3> ToFloats(const Rgb& c) {
  return {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
}

std::string ValueOf(const std::string& name, const std::array<float, 3>& c) {
  return fmt::format("{}={:.4g},{:.4g},{:.4g}", name, c[0], c[1], c[2]);
}

constexpr ImGuiColorEditFlags kPicker =
    ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel;

}  // namespace

// A switch, a dimmer, a colour, and the name. A drag is one action for undo.
void Panels::LampRow(Viewer& viewer, const Lamp& lamp) {
  const Rgb factor = FactorOf(viewer.light(), lamp.name);
  const double brightness = factor.maxCoeff();
  const Rgb kept =
      factors_before_off_.contains(lamp.name) ? factors_before_off_[lamp.name] : Rgb(Rgb::Ones());
  const Rgb hue = brightness > 0 ? Rgb(factor / brightness) : Rgb(kept / std::max(kept.maxCoeff(), 1e-9));
  ImGui::PushID(lamp.name.c_str());
  std::string chosen;
  bool on = brightness > 0;
  if (ImGui::Checkbox("##on", &on)) {
    if (!on) factors_before_off_[lamp.name] = factor;
    chosen = on ? ValueOf(lamp.name, ToFloats(kept)) : lamp.name + "=off";
  }
  ImGui::SameLine();
  auto dimmer = static_cast<float>(brightness);
  ImGui::SetNextItemWidth(8 * ImGui::GetFontSize());
  const bool dims = ImGui::SliderFloat("##dimmer", &dimmer, 0, kBrightest, "%.2f");
  bool held = ImGui::IsItemActive();
  if (dims) chosen = ValueOf(lamp.name, ToFloats(static_cast<double>(dimmer) * hue));
  ImGui::SameLine();
  std::array<float, 3> colour = ToFloats(hue);
  if (ImGui::ColorEdit3("##colour", colour.data(), kPicker)) {
    held = true;
    for (float& c : colour) c *= static_cast<float>(brightness);
    chosen = ValueOf(lamp.name, colour);
  }
  ImGui::SameLine();
  ImGui::TextUnformatted(lamp.name.c_str());
  ImGui::PopID();
  const bool merge = held && dragged_ == lamp.name;
  if (held && !chosen.empty()) dragged_ = lamp.name;
  if (!held && dragged_ == lamp.name && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) dragged_.clear();
  if (!chosen.empty()) Change(viewer, "dim", chosen, merge);
}

void Panels::PaintRow(Viewer& viewer, const Material& material) {
  std::array<float, 3> colour = ToFloats(ReflectanceOf(viewer.light(), material));
  ImGui::PushID(material.name.c_str());
  const bool changed = ImGui::ColorEdit3("##paint", colour.data(), kPicker);
  ImGui::SameLine();
  ImGui::TextUnformatted(material.name.c_str());
  ImGui::PopID();
  if (!changed) {
    if (dragged_ == material.name && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) dragged_.clear();
    return;
  }
  constexpr float kMost = 0.99F;  // a reflectance is below 1
  for (float& c : colour) c = std::clamp(c, 0.0F, kMost);
  const bool merge = dragged_ == material.name;
  dragged_ = material.name;
  Change(viewer, "paint", ValueOf(material.name, colour), merge);
}

void Panels::Lamps(Viewer& viewer) {
  if (!viewer.panels().lamps) return;
  const std::shared_ptr<const Scene> scene = viewer.opened();
  if (BeginPanel("Lamps and materials", {8, 30, 380, 340}, &viewer.panels().lamps)) {
    if (ImGui::CollapsingHeader("Lamps", ImGuiTreeNodeFlags_DefaultOpen)) {
      const std::vector<Lamp> lamps = LampsOf(*scene);
      for (const Lamp& lamp : lamps) LampRow(viewer, lamp);
      if (lamps.empty()) ImGui::TextDisabled("Nothing in this scene emits light.");
      if (!viewer.light().lamps.empty() && ImGui::Button("As in the scene##lamps"))
        Change(viewer, "dim", "none", false);
    }
    if (ImGui::CollapsingHeader("Reflectances", ImGuiTreeNodeFlags_DefaultOpen)) {
      for (const Material& material : scene->materials) PaintRow(viewer, material);
      if (!viewer.light().paints.empty() && ImGui::Button("As in the scene##paints"))
        Change(viewer, "paint", "none", false);
    }
    ImGui::TextWrapped("Over the transport that is kept: no form factor is computed.");
  }
  ImGui::End();
}

void Panels::Change(Viewer& viewer, const char* setting, const std::string& value, bool merge) {
  try {
    viewer.Set(setting, value, merge);
  } catch (const InputError& error) {
    viewer.Complain(error.what());
  }
}

}  // namespace penumbra::viewer
