// The panel of the plot over a line: curves with axes, and the file of their values.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "display/photometry.h"
#include "display/round_ticks.h"
#include "display/viewer/line_plot.h"
#include "display/viewer/panels.h"

namespace penumbra::viewer {
namespace {

struct PlotBox {
  ImVec2 at, size;
  double length, low, high;  // of the axes: [m], and the unit of light

  ImVec2 Place(double distance, double value) const {
    return {at.x + size.x * static_cast<float>(length > 0 ? distance / length : 0),
            at.y + size.y * static_cast<float>(1 - (value - low) / std::max(high - low, 1e-300))};
  }
};

constexpr int kMostTicks = 5;

void DrawAxes(const PlotBox& box, ImDrawList* draw) {
  draw->AddRectFilled(box.at, ImVec2(box.at.x + box.size.x, box.at.y + box.size.y),
                      IM_COL32(30, 30, 34, 255));
  for (const double tick : RoundTicks(box.low, box.high, kMostTicks)) {
    const ImVec2 left = box.Place(0, tick);
    draw->AddLine(left, ImVec2(box.at.x + box.size.x, left.y), IM_COL32(255, 255, 255, 40));
    draw->AddText(ImVec2(left.x + 3, left.y - ImGui::GetFontSize()), IM_COL32(200, 200, 200, 255),
                  fmt::format("{:g}", tick).c_str());
  }
  for (const double tick : RoundTicks(0, box.length, kMostTicks)) {
    const ImVec2 below = box.Place(tick, box.low);
    draw->AddLine(below, ImVec2(below.x, below.y + 4), IM_COL32(200, 200, 200, 255));
    draw->AddText(ImVec2(below.x, below.y + 5), IM_COL32(200, 200, 200, 255),
                  fmt::format("{:g}", tick).c_str());
  }
}

}  // namespace

void Panels::LinePanel(Viewer& viewer) {
  const std::shared_ptr<const LinePlot> plot = viewer.line_plot();
  if (!plot) return;
  if (!BeginPanel("Light over a line", {8, 400, 460, 290}, nullptr)) return ImGui::End();
  const bool lux = viewer.view().unit == LightUnit::kLux;
  const auto shown = [&](const Rgb& light) { return lux ? Lux(light) : light.mean(); };
  double high = 0;
  for (const LinePlot::Sample& s : plot->samples) {
    if (s.on_face) high = std::max(high, shown(s.exact));
    if (s.interpolated) high = std::max(high, shown(*s.interpolated));
  }
  const double length = plot->samples.back().distance;
  ImGui::Text("%s over %.4g m; white: exact, blue: interpolated", lux ? "lux" : "W/m^2, mean of the channels",
              length);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float buttons = ImGui::GetFrameHeightWithSpacing(), letters = ImGui::GetFontSize();
  const PlotBox box{ImGui::GetCursorScreenPos(),
                    {std::max(room.x - 10, 20.0F), std::max(room.y - buttons - letters - 12, 20.0F)},
                    length,
                    0,
                    high > 0 ? 1.05 * high : 1};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  DrawAxes(box, draw);
  for (std::size_t i = 1; i < plot->samples.size(); ++i) {
    const LinePlot::Sample &a = plot->samples[i - 1], &b = plot->samples[i];
    if (!a.on_face || !b.on_face) continue;
    draw->AddLine(box.Place(a.distance, shown(a.exact)), box.Place(b.distance, shown(b.exact)),
                  IM_COL32_WHITE, 1.5F);
    if (a.interpolated && b.interpolated)
      draw->AddLine(box.Place(a.distance, shown(*a.interpolated)),
                    box.Place(b.distance, shown(*b.interpolated)), IM_COL32(80, 140, 255, 255), 1.5F);
  }
  ImGui::Dummy(ImVec2(box.size.x, box.size.y + letters + 8));
  if (ImGui::Button("Save as CSV...")) viewer.panels().dialog = "save-line";
  ImGui::SameLine();
  if (ImGui::Button("Close")) Change(viewer, "line", "none", false);
  ImGui::End();
}

}  // namespace penumbra::viewer
