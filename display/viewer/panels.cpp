#include "display/viewer/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include "display/false_colour.h"
#include "solver/base/check.h"

namespace penumbra::viewer {
namespace {

void Copy(const std::string& text, char* field, std::size_t size) {
  const std::size_t n = std::min(text.size(), size - 1);
  std::memcpy(field, text.data(), n);
  field[n] = '\0';
}

void Text(const std::string& text) { ImGui::TextUnformatted(text.data(), text.data() + text.size()); }

ImU32 ToImGui(Colour c) { return IM_COL32(c.red, c.green, c.blue, 255); }

// The parts of a menu path: at most three, the last may hold slashes.
std::vector<std::string> PartsOf(const std::string& path) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  const bool deep = path.starts_with("File/Recent/") || path.starts_with("Cameras/Go to/");
  for (int i = 0; i < (deep ? 2 : 1); ++i) {
    const std::size_t slash = path.find('/', begin);
    parts.push_back(path.substr(begin, slash - begin));
    begin = slash + 1;
  }
  parts.push_back(path.substr(begin));
  return parts;
}

// The menus of the bar, in order.
std::vector<std::string> TopMenus(const Menu& menu) {
  std::vector<std::string> tops;
  for (const MenuItem& item : menu.items())
    if (std::string top = PartsOf(item.path)[0]; tops.empty() || tops.back() != top)
      tops.push_back(std::move(top));
  return tops;
}

constexpr float kGap = 8;

// What the drawing control panel holds, and how wide its fields and those of the parameters are.
constexpr std::string_view kControlGroups[] = {"Drawing", "Exposure", "Visualisations",
                                               "Links",   "Graphs",   "Viewing"};
constexpr std::string_view kStudies = GroupTitle(OptionGroup::kStudies);
constexpr std::string_view kParameterGroups[] = {"Scene", GroupTitle(OptionGroup::kSolving), kStudies};
constexpr float kControlField = 120, kParameterField = 150;

// The menus of the bar stand side by side where they leave room for so much of what is being computed.
constexpr float kPhaseLetters = 24;

float WidthOf(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }

// How much larger than plain everything is.
float Scale() { return ImGui::GetFontSize() / kPlainFontSize; }

// An interval, moved and shortened as little as it takes to lie between `low` and `high`.
std::pair<float, float> Within(float at, float length, float low, float high) {
  length = std::min(length, std::max(high - low, 1.0F));
  return {std::max(std::min(at, high - length), low), length};
}

// The same for a panel: into the window, below the menus.
PanelRect InWindow(const PanelRect& panel) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const auto [left, width] = Within(panel.left, panel.width, kGap, window.x - kGap);
  const auto [top, height] = Within(panel.top, panel.height, ImGui::GetFrameHeight() + kGap, window.y - kGap);
  return {left, top, width, height};
}

// Of the panel that is being drawn.
PanelRect RectNow() {
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  return {at.x, at.y, size.x, size.y};
}

void Place(const PanelRect& panel, ImGuiCond when) {
  ImGui::SetNextWindowPos(ImVec2(panel.left, panel.top), when);
  ImGui::SetNextWindowSize(ImVec2(panel.width, panel.height), when);
}

// The width of a panel that shows all labels of these groups whole, in plain pixels.
float PanelWidth(const Viewer& viewer, std::span<const std::string_view> groups, float field) {
  const ImGuiStyle& style = ImGui::GetStyle();
  float widest = 0;
  for (const Setting& setting : viewer.settings().all())
    if (std::find(groups.begin(), groups.end(), setting.group) != groups.end())
      widest = std::max(
          widest, ImGui::CalcTextSize(setting.help.c_str()).x +
                      (setting.kind == SettingKind::kToggle ? ImGui::GetFrameHeight() : field * Scale()));
  return (widest + style.ItemInnerSpacing.x + 2 * style.WindowPadding.x + style.ScrollbarSize) / Scale();
}

}  // namespace

template <class Action>
bool Panels::Try(Viewer& viewer, const Action& action) {
  try {
    action();
    return true;
  } catch (const InputError& error) {
    viewer.Complain(error.what());
    return false;
  }
}

void Panels::Run(Viewer& viewer, const std::string& menu) {
  Try(viewer, [&] { viewer.RunMenu(menu); });
}

bool Panels::Typing() { return ImGui::GetIO().WantTextInput && ImGui::IsAnyItemActive(); }

bool Panels::WantsKeys(Viewer& viewer) const {
  return Typing() || !refused_.empty() || !viewer.panels().dialog.empty() ||
         !viewer.panels().question.empty();
}

bool Panels::IsOpening(Viewer& viewer) const {
  return (!viewer.panels().dialog.empty() || !refused_.empty()) && !Typing();
}

void Panels::Draw(Viewer& viewer) {
  MenuBar(viewer);
  ControlPanel(viewer);
  Parameters(viewer);
  Lamps(viewer);
  TimeLine(viewer);
  Outline(viewer);
  LinePanel(viewer);
  Details(viewer);
  Report(viewer);
  Help(viewer);
  Dialog(viewer);
  Question(viewer);
  Message(viewer);
  Legend(viewer);
  Hover(viewer);
  if (!ImGui::IsAnyItemActive()) EndEdit(viewer);  // of a field that is not shown any more
}

// Begins a panel, which opens there the first time, in plain pixels. When the window's size has changed it is
// put inside, from where the user had it: it goes back as the window grows. End() has to follow.
bool Panels::BeginPanel(const char* name, const PanelRect& first, bool* open) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float scale = Scale();
  const auto known = places_.find(name);
  const bool moves = known != places_.end() && known->second.window != std::pair(window.x, window.y);
  if (moves)
    Place(InWindow(known->second.wanted), ImGuiCond_Always);
  else
    Place(InWindow({scale * first.left, scale * first.top, scale * first.width, scale * first.height}),
          ImGuiCond_FirstUseEver);
  const bool shows = ImGui::Begin(name, open);
  if (moves) known->second.window = {window.x, window.y};
  if (ImGui::IsWindowCollapsed()) return shows;
  const PanelRect now = RectNow();
  if (known == places_.end()) {
    places_[name] = {now, now, {}};
    return shows;
  }
  PanelPlace& place = known->second;
  if (!moves && now != place.shown && ImGui::IsMouseDown(ImGuiMouseButton_Left)) place.wanted = now;
  place.shown = now;
  return shows;
}

void Panels::MenuBar(Viewer& viewer) {
  if (!ImGui::BeginMainMenuBar()) return;
  std::string run;
  float width = WidthOf("Cancel") + kPhaseLetters * WidthOf("m");
  for (const std::string& top : TopMenus(viewer.menu()))
    width += WidthOf(top) + 2 * ImGui::GetStyle().ItemSpacing.x;
  if (width <= ImGui::GetIO().DisplaySize.x) {
    Menus(viewer, &run);
  } else if (ImGui::BeginMenu("Menu")) {  // in a window without room for all of them
    Menus(viewer, &run);
    ImGui::EndMenu();
  }
  Status(viewer);
  ImGui::EndMainMenuBar();
  if (!run.empty()) Try(viewer, [&] { viewer.RunMenu(run); });
}

// `run`: the path of the item that was chosen.
void Panels::Menus(const Viewer& viewer, std::string* run) {
  for (const std::string& top : TopMenus(viewer.menu())) {
    if (!ImGui::BeginMenu(top.c_str())) continue;
    for (const MenuItem& item : viewer.menu().items()) {
      const std::vector<std::string> parts = PartsOf(item.path);
      if (parts[0] != top || (parts.size() == 3 && !ImGui::BeginMenu(parts[1].c_str()))) continue;
      const bool checked = item.checked && item.checked();
      if (ImGui::MenuItem(parts.back().c_str(), item.key.c_str(), checked)) *run = item.path;
      if (ImGui::IsItemHovered() && !item.help.empty()) ImGui::SetTooltip("%s", item.help.c_str());
      if (parts.size() == 3) ImGui::EndMenu();
    }
    ImGui::EndMenu();
  }
}

// The status indicator, upper right (thesis B.2): what is being done, how far, and a button that ends it.
void Panels::Status(Viewer& viewer) {
  const SessionStatus status = viewer.status();
  std::string text =
      fmt::format("{}{}, {:.0f} s", status.cancelling ? "ending " : "", status.text, status.seconds);
  if (!status.busy) text = viewer.activity();
  const double fps = viewer.seconds_a_frame() > 0 ? 1 / viewer.seconds_a_frame() : 0;
  const std::string rate = fmt::format("{:.0f} fps", fps);
  const ImGuiStyle& style = ImGui::GetStyle();
  const float bar = 90 * Scale(), gap = style.ItemSpacing.x;
  // What there is no room for is left out, the button last.
  float room = ImGui::GetWindowWidth() - ImGui::GetCursorPosX() - kGap, width = 0;
  const auto fits = [&](float part) {
    if (width + part + gap > room) return false;
    width += part + gap;
    return true;
  };
  if (status.busy && WidthOf(text) + WidthOf(rate) + WidthOf("Cancel") + 4 * gap > room)
    text = status.phase;  // in few words
  if (status.busy) room -= WidthOf("Cancel") + 2 * style.FramePadding.x + gap;
  const bool shows_text = fits(WidthOf(text)), shows_rate = shows_text && fits(WidthOf(rate)),
             shows_bar = status.busy && shows_rate && fits(bar);
  ImGui::SameLine(ImGui::GetCursorPosX() + std::max(room - width, 0.0F));
  if (shows_bar) {
    ImGui::ProgressBar(static_cast<float>(status.fraction), ImVec2(bar, 0));
  }
  if (status.busy && ImGui::SmallButton("Cancel")) viewer.RunMenu("Iteration/Cancel");
  if (shows_text) Text(text);
  if (shows_rate) ImGui::TextDisabled("%s", rate.c_str());
}

// Takes what was typed into a field, however the user left it; Escape has put back what was there. Text that
// is refused after Enter stays in its field, which gets the keys again: whoever types on must not press
// shortcuts.
void Panels::EndEdit(Viewer& viewer) {
  const std::string name = std::exchange(edited_, {});
  if (name.empty() || edit_ == unedited_) return;
  const bool entered = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
  if (!Try(viewer, [&] { viewer.Set(name, edit_); }) && entered) refused_ = name;
}

// A slider for a positive number. Returns what it has been moved to, else `value`.
std::string Panels::Slider(const Setting& setting, const std::string& label, const std::string& value) {
  std::string chosen = value;
  // Sliders reach a thousandfold either way of where they are. While one is held its ends stay: they
  // would run away from under the pointer.
  auto number = static_cast<float>(NumberFrom(value, -1e30, 1e30));
  float low = std::max(number / 1000, static_cast<float>(setting.low));
  float high = std::min(number * 1000, static_cast<float>(setting.high));
  if (slid_ == setting.name) {
    low = slid_low_;
    high = slid_high_;
  }
  if (ImGui::SliderFloat(label.c_str(), &number, low, high, "%.4g", ImGuiSliderFlags_Logarithmic))
    chosen = TextOf(static_cast<double>(number));
  if (ImGui::IsItemActive()) {
    if (slid_ != setting.name) slides_on_ = false;
    slid_ = setting.name;
    slid_low_ = low;
    slid_high_ = high;
  } else if (slid_ == setting.name) {
    slid_.clear();
  }
  return chosen;
}

// A field for text, which the viewer takes when the user leaves it.
void Panels::Field(Viewer& viewer, const Setting& setting, const std::string& label,
                   const std::string& value) {
  // The field is the user's while he types, and shows the value otherwise.
  const bool again = refused_ == setting.name;
  if (again) ImGui::SetKeyboardFocusHere();
  char shown[sizeof edit_];
  Copy(again || edited_ == setting.name ? std::string(edit_) : value, shown, sizeof shown);
  ImGui::InputText(label.c_str(), shown, sizeof shown);
  if (edited_ == setting.name) std::memcpy(edit_, shown, sizeof shown);
  if (ImGui::IsItemActive()) {
    if (again) refused_.clear();
    if (edited_ != setting.name) {
      EndEdit(viewer);  // of another field, which Tab leaves
      edited_ = setting.name;
      unedited_ = value;
      std::memcpy(edit_, shown, sizeof shown);
    }
  } else if (edited_ == setting.name) {
    EndEdit(viewer);
  }
}

void Panels::Widget(Viewer& viewer, const Setting& setting) {
  const std::string value = setting.get();
  const std::string label = setting.help + "##" + setting.name;
  std::string chosen = value;
  switch (setting.kind) {
    case SettingKind::kToggle: {
      bool on = value == "on";
      if (ImGui::Checkbox(label.c_str(), &on)) chosen = on ? "on" : "off";
      break;
    }
    case SettingKind::kChoice:
      if (ImGui::BeginCombo(label.c_str(), value.c_str())) {
        for (const std::string& choice : setting.choices)
          if (ImGui::Selectable(choice.c_str(), choice == value)) chosen = choice;
        ImGui::EndCombo();
      }
      break;
    case SettingKind::kInteger:
    case SettingKind::kNumber:
      if (setting.logarithmic && !setting.automatic)
        chosen = Slider(setting, label, value);
      else
        Field(viewer, setting, label, value);
      break;
    case SettingKind::kText:
      Field(viewer, setting, label, value);
      break;
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("set %s %s", setting.name.c_str(), value.c_str());
  const bool slides = slid_ == setting.name;
  if (chosen != value) {
    Try(viewer, [&] { viewer.Set(setting.name, chosen, slides && slides_on_); });
    if (slides) slides_on_ = true;
  }
}

void Panels::Group(Viewer& viewer, std::string_view group) {
  for (const Setting& setting : viewer.settings().all())
    if (setting.group == group) Widget(viewer, setting);
}

void Panels::ControlPanel(Viewer& viewer) {
  if (!viewer.panels().control) return;
  if (BeginPanel("Drawing Control Panel", {kGap, 30, PanelWidth(viewer, kControlGroups, kControlField), 620},
                 &viewer.panels().control)) {
    ImGui::PushItemWidth(kControlField * Scale());
    for (const std::string_view group : kControlGroups)
      if (ImGui::CollapsingHeader(group.data(), ImGuiTreeNodeFlags_DefaultOpen)) Group(viewer, group);
    ImGui::PopItemWidth();
  }
  ImGui::End();
}

void Panels::Parameters(Viewer& viewer) {
  if (!viewer.panels().parameters) return;
  const float beside = PanelWidth(viewer, kControlGroups, kControlField) + 2 * kGap;
  if (BeginPanel("Parameters", {beside, 30, PanelWidth(viewer, kParameterGroups, kParameterField), 360},
                 &viewer.panels().parameters)) {
    ImGui::PushItemWidth(kParameterField * Scale());
    for (const std::string_view group : kParameterGroups)
      if (group != kStudies || ImGui::CollapsingHeader(group.data())) Group(viewer, group);
    ImGui::PopItemWidth();
    ImGui::TextDisabled("The next iteration starts over where they differ.");
    for (const char* path : {"Iteration/Iterate", "Iteration/Iterate to convergence"}) {
      if (ImGui::Button(path + sizeof("Iteration"))) Run(viewer, path);
      ImGui::SameLine();
    }
  }
  ImGui::End();
}

void Panels::Details(Viewer& viewer) {
  const std::vector<std::string> lines = viewer.Details();
  if (!viewer.panels().details || lines.empty()) return;
  ImGui::SetNextWindowPos(ImVec2(ImGui::GetIO().DisplaySize.x - kGap, 30), ImGuiCond_FirstUseEver,
                          ImVec2(1, 0));
  if (ImGui::Begin("Details", nullptr, ImGuiWindowFlags_AlwaysAutoResize))
    for (const std::string& line : lines) Text(line);
  // It grows with what it tells: back into the window where it stands out.
  const PanelRect now = RectNow(), inside = InWindow(now);
  if (inside.left != now.left || inside.top != now.top) ImGui::SetWindowPos(ImVec2(inside.left, inside.top));
  ImGui::End();
}

void Panels::Report(Viewer& viewer) {
  if (!viewer.panels().report) return;
  // In the lower right corner, below the details and the parameters.
  constexpr float kWidth = 480, kHeight = 360;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  if (BeginPanel("Report", {display.x / Scale() - kWidth, display.y / Scale() - kHeight, kWidth, kHeight},
                 &viewer.panels().report)) {
    const Snapshot& now = viewer.snapshot();
    Text(fmt::format("{} patches, {} iterations{}, {} corrections", now.scene->patches.size(),
                     now.iterations.size(), now.converged ? ", converged" : "", now.corrections));
    if (ImGui::BeginTable("iterations", 5, ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV)) {
      for (const char* column : {"iteration", "residual", "elements", "links", "seconds"})
        ImGui::TableSetupColumn(column);
      ImGui::TableHeadersRow();
      for (std::size_t i = 0; i < now.iterations.size(); ++i) {
        const IterationReport& r = now.iterations[i];
        for (const std::string& cell :
             {fmt::format("{}", i + 1), fmt::format("{:.2g}", r.residual), fmt::format("{}", r.elements),
              fmt::format("{}", r.links), fmt::format("{:.2f}", r.seconds)}) {
          ImGui::TableNextColumn();
          Text(cell);
        }
      }
      ImGui::EndTable();
    }
    for (std::size_t k = 0; k < kMeshKinds; ++k) {
      const char* name = NameOf(static_cast<MeshKind>(k));
      if (now.mesh[k]) Text(fmt::format("{}: {} triangles", name, now.mesh[k]->mesh().triangles.size()));
    }
    if (now.measured) {
      const PipelineReport& m = *now.measured;
      Text(fmt::format("energy: {:.5g} W emitted, imbalance {:.2g}", m.energy.emitted,
                       m.energy.relative_imbalance));
      Text(fmt::format("interpolants: error {:.3g} (99 %), {:.3g} (95 %), at {} points",
                       m.interpolant_error.p99, m.interpolant_error.p95, m.interpolant_error.points));
      Text(fmt::format("solution: error {:.3g}, estimated; asked for {:g}: {}", m.solution_error_estimate,
                       m.error_asked, m.error_met ? "met" : "not met"));
    }
    const FrameTimes& ms = viewer.picture().times();
    Text(fmt::format("frame: ids {:.1f}, coordinates {:.1f}, evaluation {:.1f}, tones {:.1f} ms",
                     ms.triangle_ids, ms.barycentric, ms.evaluate, ms.tone_map));
    if (ImGui::Button("Measure")) viewer.RunMenu("Iteration/Measure");
  }
  ImGui::End();
}

void Panels::Help(Viewer& viewer) {
  if (!viewer.panels().help) return;
  if (BeginPanel("Keyboard and mouse", {120, 40, 620, 560}, &viewer.panels().help)) {
    constexpr const char* kMouse[][2] = {
        {"left drag", "arcball: rotate; with shift about an axis of the view, with ctrl about x, y or z"},
        {"middle drag", "arcball: move; with shift zoom, with ctrl change the perspective"},
        {"wheel", "arcball: zoom; walk: speed"},
        {"click", "select: a patch, then its children; a link, then its tube; a triangle; a discontinuity"},
        {"double click", "on the background: unselect all"},
        {"right click", "irradiance at a point; with shift its backprojection on every source"},
        {"walk: w a s d q e, arrows", "forward, left, back, right, down, up"},
        {"walk: left, right held", "forward, back; middle held: turn towards the pointer"},
        {"walk: mouse look", "the pointer is held; escape lets it go"},
        {"walk: alt+click", "as a click otherwise"}};
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg)) {
      ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed);
      ImGui::TableSetupColumn("does");
      const auto row = [](const std::string& key, const std::string& does) {
        ImGui::TableNextColumn();
        Text(key);
        ImGui::TableNextColumn();
        ImGui::TextWrapped("%s", does.c_str());
      };
      for (const auto& [key, does] : kMouse) row(key, does);
      for (const MenuItem& item : viewer.menu().items())
        if (!item.key.empty()) row(item.key, item.path);
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

// Asks for the value of a setting that names a file or a camera. A value that is refused stays, with the
// reason, until it is mended or the dialog is cancelled.
void Panels::Dialog(Viewer& viewer) {
  std::string& name = viewer.panels().dialog;
  if (name.empty()) {
    asked_.clear();
    refusal_.clear();
    return;
  }
  const Setting* setting = viewer.settings().Find(name);
  // A question, a field and a row of buttons.
  const float height = ImGui::GetTextLineHeightWithSpacing() + 2 * ImGui::GetFrameHeightWithSpacing() +
                       2 * ImGui::GetStyle().WindowPadding.y;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float top = InWindow({0, 120, window.x, height}).top;
  ImGui::SetNextWindowPos(ImVec2(window.x / 2, top), ImGuiCond_Always, ImVec2(0.5F, 0));
  if (ImGui::Begin(
          "##dialog", nullptr,
          ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoSavedSettings))
    DialogField(viewer, *setting);
  ImGui::End();
}

void Panels::DialogField(Viewer& viewer, const Setting& setting) {
  std::string& name = viewer.panels().dialog;
  Text(setting.help);
  if (asked_ != name) {
    asked_ = name;
    text_[0] = '\0';
    refusal_.clear();
  }
  // The keys are the dialog's as long as it is open.
  if (!ImGui::IsAnyItemActive() && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) ImGui::SetKeyboardFocusHere();
  const float width = ImGui::GetIO().DisplaySize.x;
  ImGui::PushItemWidth(std::min(460 * Scale(), std::max(width - 60, 60.0F)));
  const bool entered = ImGui::InputText("##value", text_, sizeof text_, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::PopItemWidth();
  const bool done = ImGui::Button("OK") || entered;
  ImGui::SameLine();
  const bool cancelled =
      ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
  if (!refusal_.empty()) ImGui::TextColored(ImVec4(1, 0.6F, 0.4F, 1), "%s", refusal_.c_str());
  if (cancelled || (done && text_[0] == '\0')) {
    name.clear();
  } else if (done) {
    try {
      // The setting may open another dialog, and then this one's name is gone.
      const std::string option = std::exchange(name, {});
      viewer.Set(option, text_);
    } catch (const InputError& error) {
      name = setting.name;
      refusal_ = error.what();
    }
  }
}

// Before work is lost that undo cannot bring back.
void Panels::Question(Viewer& viewer) {
  std::string& question = viewer.panels().question;
  if (question.empty()) return;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(window.x / 2, InWindow({0, 120, window.x, 80}).top), ImGuiCond_Always,
                          ImVec2(0.5F, 0));
  if (ImGui::Begin("##question", nullptr,
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar |
                       ImGuiWindowFlags_NoSavedSettings)) {
    ImGui::PushTextWrapPos(std::min(460 * Scale(), std::max(window.x - 60, 60.0F)));
    ImGui::TextWrapped("%s", question.c_str());
    ImGui::PopTextWrapPos();
    const char* run = nullptr;
    if (ImGui::Button("Save...")) run = "File/Save solution...";
    ImGui::SameLine();
    if (ImGui::Button("Quit without saving")) run = "File/Quit without saving";
    ImGui::SameLine();
    const bool stays = ImGui::Button("Stay (escape)");
    if (run || stays || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) question.clear();
    if (run) Try(viewer, [&] { viewer.RunMenu(run); });
  }
  ImGui::End();
}

void Panels::Message(Viewer& viewer) {
  static_cast<void>(this);
  const std::string message = viewer.message();
  if (message.empty()) return;
  ImGui::SetNextWindowPos(ImVec2(kGap, ImGui::GetIO().DisplaySize.y - kGap), ImGuiCond_Always, ImVec2(0, 1));
  if (ImGui::Begin("##message", nullptr,
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar |
                       ImGuiWindowFlags_NoSavedSettings)) {
    ImGui::PushTextWrapPos(std::max(200.0F, ImGui::GetIO().DisplaySize.x - 60));
    ImGui::TextColored(ImVec4(1, 0.6F, 0.4F, 1), "%s", message.c_str());
    ImGui::PopTextWrapPos();
    if (ImGui::SmallButton("Dismiss")) viewer.Dismiss();
  }
  ImGui::End();
}

// What is under the pointer, in one line along the lower border.
void Panels::Hover(Viewer& viewer) {
  static_cast<void>(this);
  if (!viewer.panels().hover || ImGui::GetIO().WantCaptureMouse) return;
  const std::string line = viewer.Hover();
  if (line.empty()) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float top = size.y - ImGui::GetFontSize() - 4;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->AddRectFilled(ImVec2(0, top), ImVec2(std::min(WidthOf(line) + 12, size.x), size.y),
                      IM_COL32(20, 20, 20, 190));
  draw->AddText(ImVec2(6, top + 2), IM_COL32(230, 230, 230, 255), line.c_str());
}

// The scale of false colours: smaller in a window that has no room for it.
void Panels::Legend(Viewer& viewer) {
  const ColourScale colours = viewer.picture().scale();
  if (colours == ColourScale::kNone) return;
  constexpr float kWidth = 112, kHeight = 270, kBarTop = 34, kBarLeft = 12, kBarWidth = 18, kBarHeight = 220;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float menus = ImGui::GetFrameHeight();
  const float scale = std::max(
      std::min({Scale(), (size.x - 2 * kGap) / kWidth, (size.y - menus - 2 * kGap) / kHeight}), 0.0F);
  const float letters = kPlainFontSize * scale;
  const ImVec2 box(size.x - kGap - kWidth * scale, size.y - kGap - kHeight * scale);
  const ImVec2 bar(box.x + kBarLeft * scale, box.y + kBarTop * scale);
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->AddRectFilled(box, ImVec2(box.x + kWidth * scale, box.y + kHeight * scale), IM_COL32(20, 20, 20, 190),
                      4);
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps; ++i) {
    const float y = bar.y + kBarHeight * scale * static_cast<float>(kSteps - 1 - i) / kSteps;
    draw->AddRectFilled(ImVec2(bar.x, y),
                        ImVec2(bar.x + kBarWidth * scale, y + kBarHeight * scale / kSteps + 1),
                        ToImGui(FalseColour((i + 0.5) / kSteps)));
  }
  const auto write = [&](float x, float y, const std::string& text) {
    draw->AddText(ImGui::GetFont(), letters, ImVec2(x, y), IM_COL32_WHITE, text.c_str());
  };
  write(box.x + 8 * scale, box.y + 6 * scale, UnitOf(colours));
  constexpr int kTicks = 4;
  for (int i = 0; i <= kTicks; ++i) {
    const float x = bar.x + kBarWidth * scale;
    const float y = bar.y + kBarHeight * scale * static_cast<float>(kTicks - i) / kTicks;
    draw->AddLine(ImVec2(x, y), ImVec2(x + 5 * scale, y), IM_COL32_WHITE);
    write(x + 9 * scale, y - letters / 2,
          fmt::format("{:.3g}", viewer.picture().scale_values().ValueAt(static_cast<double>(i) / kTicks)));
  }
}

}  // namespace penumbra::viewer
