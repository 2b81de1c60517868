// The time line: what each step of the solver did, as curves that grow, and the way back to it.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "display/viewer/panels.h"
#include "solver/base/check.h"

namespace penumbra::viewer {
namespace {

// A curve over the steps. Values that are unknown are gaps.
struct StepCurve {
  const char* name;
  bool logarithmic;
  std::function<double(const StepRecord&)> value;  // negative: unknown
};

const std::vector<StepCurve>& Curves() {
  static const std::vector<StepCurve> curves = {
      {"residual", true, [](const StepRecord& r) { return r.residual > 0 ? r.residual : -1; }},
      {"change of light", true, [](const StepRecord& r) { return r.change > 0 ? r.change : -1; }},
      {"error", true, [](const StepRecord& r) { return r.error > 0 ? r.error : -1; }},
      {"links", false, [](const StepRecord& r) { return r.links > 0 ? static_cast<double>(r.links) : -1; }},
      {"leaves", false,
       [](const StepRecord& r) { return r.leaves > 0 ? static_cast<double>(r.leaves) : -1; }},
      {"triangles", false,
       [](const StepRecord& r) { return r.triangles > 0 ? static_cast<double>(r.triangles) : -1; }}};
  return curves;
}

// The smallest and the largest value that a curve shows, on its scale.
struct CurveRange {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

double Scaled(const StepCurve& curve, double value) { return curve.logarithmic ? std::log10(value) : value; }

CurveRange RangeOfCurve(const StepCurve& curve, const std::vector<StepRecord>& steps) {
  CurveRange range;
  for (const StepRecord& step : steps) {
    const double value = curve.value(step);
    if (value < 0) continue;
    range.low = std::min(range.low, Scaled(curve, value));
    range.high = std::max(range.high, Scaled(curve, value));
  }
  if (!curve.logarithmic) range.low = std::min(range.low, 0.0);
  return range;
}

// Draws the points of a curve; returns the last value that is shown, negative if there is none.
double DrawPoints(const StepCurve& curve, const std::vector<StepRecord>& steps, std::size_t shown, ImVec2 at,
                  ImVec2 size) {
  const auto [low, high] = RangeOfCurve(curve, steps);
  double last = -1;
  std::optional<ImVec2> before;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double value = curve.value(steps[i]);
    if (value < 0) continue;
    const double part = high > low ? (Scaled(curve, value) - low) / (high - low) : 0.5;
    const ImVec2 point(at.x + size.x * (static_cast<float>(i) + 0.5F) / static_cast<float>(steps.size()),
                       at.y + size.y * static_cast<float>(0.92 - 0.6 * part));
    const ImU32 colour = i < shown ? IM_COL32(255, 200, 90, 255) : IM_COL32(130, 120, 100, 255);
    if (before) ImGui::GetWindowDrawList()->AddLine(*before, point, colour, 1.5F);
    ImGui::GetWindowDrawList()->AddCircleFilled(point, 2.5F, colour);
    before = point;
    if (i < shown) last = value;
  }
  return last;
}

// Draws one curve in a box of its own, and a line at the step that is shown. Returns the step that was
// clicked; 0: none.
std::size_t DrawCurve(const StepCurve& curve, const std::vector<StepRecord>& steps, std::size_t shown,
                      float height) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0F);
  ImGui::InvisibleButton(curve.name, ImVec2(width, height));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(at, ImVec2(at.x + width, at.y + height), IM_COL32(30, 30, 34, 255));
  const double last = DrawPoints(curve, steps, shown, at, ImVec2(width, height));
  if (shown > 0 && shown <= steps.size()) {
    const float x = at.x + width * (static_cast<float>(shown) - 0.5F) / static_cast<float>(steps.size());
    draw->AddLine(ImVec2(x, at.y), ImVec2(x, at.y + height), IM_COL32(255, 255, 255, 90));
  }
  const std::string title =
      last < 0 ? fmt::format("{}: -", curve.name) : fmt::format("{}: {:.4g}", curve.name, last);
  draw->AddText(ImVec2(at.x + 4, at.y + 1), IM_COL32(220, 220, 220, 255), title.c_str());
  if (steps.empty() || !ImGui::IsItemHovered()) return 0;
  const float along = (ImGui::GetIO().MousePos.x - at.x) / width * static_cast<float>(steps.size());
  const auto under =
      static_cast<std::size_t>(std::clamp(along, 0.0F, static_cast<float>(steps.size()) - 0.5F));
  const StepRecord& r = steps[under];
  ImGui::SetTooltip("step %zu: %s, %.3g s%s", under + 1, r.name.c_str(), r.seconds,
                    r.place ? "" : " (too far back to return to)");
  return ImGui::IsItemClicked() ? under + 1 : 0;
}

}  // namespace

void Panels::TimeLine(Viewer& viewer) {
  if (!viewer.panels().steps) return;
  const std::shared_ptr<const std::vector<StepRecord>> steps = viewer.steps();
  const std::size_t shown = viewer.step();
  if (BeginPanel("Time line", {400, 30, 420, 420}, &viewer.panels().steps)) {
    struct Act {
      const char *label, *menu;
    };
    for (const auto& [label, menu] : {Act{"< back", "Iteration/Step back"}, Act{"step >", "Iteration/Step"},
                                      Act{viewer.playing() ? "pause" : "play", "Iteration/Play"},
                                      Act{"to the end", "Iteration/Iterate to convergence"}}) {
      if (ImGui::Button(label)) Run(viewer, menu);
      ImGui::SameLine();
    }
    const std::string where =
        shown > 0 && shown <= steps->size()
            ? fmt::format("{} of {}: {}", shown, steps->size(), (*steps)[shown - 1].name)
            : std::string("no step yet");
    ImGui::TextUnformatted(where.c_str());
    const float height = std::max((ImGui::GetContentRegionAvail().y / static_cast<float>(Curves().size())) -
                                      ImGui::GetStyle().ItemSpacing.y,
                                  3 * ImGui::GetFontSize());
    for (const StepCurve& curve : Curves())
      if (const std::size_t clicked = DrawCurve(curve, *steps, shown, height); clicked > 0)
        Change(viewer, "step", std::to_string(clicked), false);
  }
  ImGui::End();
}

}  // namespace penumbra::viewer
