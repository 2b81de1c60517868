// The panels around the picture, without a window: what lies where, and what can be reached.

#include "display/viewer/panels.h"

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/viewer/viewer_test_scenes.h"

namespace penumbra::viewer {
namespace {

using viewer_test::Options;
using viewer_test::ShadowScene;

// ImGui in a display of a given size, letters `scale` times as large as plain ones.
class Stage {
 public:
  Stage(float width, float height, float scale, ViewerOptions options = Options(false))
      : viewer_(ShadowScene(), std::move(options)) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = ImVec2(width, height);
    io.DeltaTime = 0.02F;
    io.KeyMap[ImGuiKey_Escape] = kEscape;
    io.KeyMap[ImGuiKey_Enter] = kEnter;
    ImFontConfig font;
    font.SizePixels = std::round(kPlainFontSize * scale);
    io.Fonts->AddFontDefault(&font);
    ImGui::GetStyle().ScaleAllSizes(scale);
    unsigned char* pixels = nullptr;
    int w = 0, h = 0;
    io.Fonts->GetTexDataAsAlpha8(&pixels, &w, &h);
  }
  ~Stage() { ImGui::DestroyContext(); }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  void Frames(int count = 5) {
    for (int i = 0; i < count; ++i) {
      viewer_.Frame(64, 48, 0.02);
      ImGui::NewFrame();
      panels_.Draw(viewer_);
      ImGui::Render();
    }
  }
  void Point(float x, float y) {
    ImGui::GetIO().MousePos = ImVec2(x, y);
    Frames();
  }
  void Click(float x, float y) {
    Point(x, y);
    ImGui::GetIO().MouseDown[0] = true;
    Frames(2);
    ImGui::GetIO().MouseDown[0] = false;
    Frames();
  }
  void Drag(ImVec2 from, ImVec2 to) {
    Point(from.x, from.y);
    ImGui::GetIO().MouseDown[0] = true;
    Frames(2);
    Point(to.x, to.y);
    ImGui::GetIO().MouseDown[0] = false;
    Frames();
  }
  void DoubleClick(ImVec2 at) {
    Point(at.x, at.y);
    for (int i = 0; i < 2; ++i)
      for (const bool down : {true, false}) {
        ImGui::GetIO().MouseDown[0] = down;
        Frames(1);
      }
    Frames();
  }
  void Type(const char* text) {
    ImGui::GetIO().AddInputCharactersUTF8(text);
    Frames();
  }
  void Press(int key) {
    for (const bool down : {true, false}) {
      ImGui::GetIO().KeysDown[key] = down;
      Frames(2);
    }
  }
  // Where the pointer, on its way along a line, meets an item first; nothing if it does not.
  std::optional<ImVec2> Find(ImGuiID id, ImVec2 from, ImVec2 step) {
    const ImVec2 end = ImGui::GetIO().DisplaySize;
    for (ImVec2 at = from; at.x < end.x && at.y < end.y; at.x += step.x, at.y += step.y) {
      ImGui::GetIO().MousePos = at;
      Frames(2);
      if (GImGui->HoveredId == id) return at;
    }
    return std::nullopt;
  }
  // The same down a panel.
  ImVec2 FindField(const char* panel, const Setting& setting) {
    ImGuiWindow* window = ImGui::FindWindowByName(panel);
    const std::string item = setting.help + "##" + setting.name;
    const auto at = Find(window->GetIDNoKeepAlive(item.c_str()),
                         ImVec2(window->WorkRect.Min.x + 20, window->Pos.y), {0, 4});
    EXPECT_TRUE(at) << setting.name;
    return at.value_or(ImVec2(0, 0));
  }
  const Setting& Option(const std::string& name) { return *viewer_.settings().Find(name); }
  Viewer& viewer() { return viewer_; }

  static constexpr int kEscape = 1, kEnter = 2;

 private:
  Viewer viewer_;
  Panels panels_;
};

constexpr const char* kControl = "Drawing Control Panel";

void OpenPanels(Stage& stage) {
  for (const char* panel : {"control-panel", "parameters", "report"}) stage.viewer().Set(panel, "on");
  stage.Frames();
}

// No label is cut off in a panel that nobody has made larger, however large the letters are.
TEST(Panels, ShowTheirLabelsWhole) {
  for (const float scale : {1.0F, 2.0F}) {
    Stage stage(1400 * scale, 900 * scale, scale);
    OpenPanels(stage);
    for (const char* name : {kControl, "Parameters"}) {
      const ImGuiWindow* panel = ImGui::FindWindowByName(name);
      ASSERT_NE(panel, nullptr) << name;
      EXPECT_LE(panel->ContentSize.x, panel->WorkRect.GetWidth() + 1) << name;
    }
  }
}

// Panels open beside one another, where the window has room for that.
TEST(Panels, OpenBesideOneAnother) {
  Stage stage(1280, 800, 1);
  OpenPanels(stage);
  const char* const names[] = {kControl, "Parameters", "Report"};
  for (const char* a : names)
    for (const char* b : names) {
      if (a == b) continue;
      const ImRect one = ImGui::FindWindowByName(a)->Rect(), other = ImGui::FindWindowByName(b)->Rect();
      EXPECT_FALSE(one.Overlaps(other)) << a << " and " << b;
    }
}

constexpr const char* kPanels[] = {kControl, "Parameters", "Report", "Keyboard and mouse"};

ImRect RectOf(const char* panel) { return ImGui::FindWindowByName(panel)->Rect(); }

// All of it is seen, below the menus.
void ExpectInside(const char* panel) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const ImRect rect = RectOf(panel);
  EXPECT_GE(rect.Min.x, 0) << panel << ", " << window.x << " x " << window.y;
  EXPECT_GE(rect.Min.y, ImGui::GetFrameHeight()) << panel << ", " << window.x << " x " << window.y;
  EXPECT_LE(rect.Max.x, window.x) << panel << ", " << window.x << " x " << window.y;
  EXPECT_LE(rect.Max.y, window.y) << panel << ", " << window.x << " x " << window.y;
}

// Whatever the size of the window and the letters, a panel opens inside.
TEST(Panels, OpenInsideTheWindow) {
  for (const auto& [width, height, scale] : {std::tuple{1280.0F, 800.0F, 1.0F},
                                             {1280.0F, 800.0F, 3.0F},
                                             {660.0F, 460.0F, 1.5F},
                                             {400.0F, 300.0F, 1.0F}}) {
    Stage stage(width, height, scale);
    OpenPanels(stage);
    stage.viewer().Set("help", "on");
    stage.Frames();
    for (const char* panel : kPanels) ExpectInside(panel);
  }
}

// So does a dialog, in a window that is high enough for one.
TEST(Panels, DialogsOpenInsideTheWindow) {
  for (const auto& [width, height, scale] :
       {std::tuple{1280.0F, 800.0F, 1.0F}, {640.0F, 260.0F, 2.0F}, {300.0F, 120.0F, 1.0F}}) {
    Stage stage(width, height, scale);
    for (const char* item : {"File/Open...", "Cameras/Save as..."}) {
      stage.viewer().RunMenu(item);
      stage.Frames();
      ExpectInside("##dialog");
    }
  }
}

// Panels stay inside when the window shrinks, and are where the user had them once it has grown again.
TEST(Panels, FollowTheWindow) {
  Stage stage(1280, 800, 1);
  OpenPanels(stage);
  stage.viewer().Set("help", "on");
  stage.Frames();
  const ImRect parameters = RectOf("Parameters");
  stage.Drag(ImVec2(parameters.GetCenter().x, parameters.Min.y + 8), ImVec2(1000, 400));
  EXPECT_NE(RectOf("Parameters").Min.y, parameters.Min.y);
  std::vector<ImRect> before;
  for (const char* panel : kPanels) before.push_back(RectOf(panel));
  for (const auto& [width, height] :
       {std::pair(900.0F, 700.0F), {400.0F, 300.0F}, {1.0F, 1.0F}, {640.0F, 480.0F}, {1280.0F, 800.0F}}) {
    ImGui::GetIO().DisplaySize = ImVec2(width, height);
    stage.Frames();
    if (width > 1)
      for (const char* panel : kPanels) ExpectInside(panel);
  }
  for (std::size_t i = 0; i < before.size(); ++i) {
    const ImRect now = RectOf(kPanels[i]);
    EXPECT_EQ(now.Min.x, before[i].Min.x) << kPanels[i];
    EXPECT_EQ(now.Min.y, before[i].Min.y) << kPanels[i];
    EXPECT_EQ(now.Max.x, before[i].Max.x) << kPanels[i];
    EXPECT_EQ(now.Max.y, before[i].Max.y) << kPanels[i];
  }
  // One that is closed while the window shrinks opens inside, too.
  stage.viewer().Set("report", "off");
  stage.Frames();
  ImGui::GetIO().DisplaySize = ImVec2(500, 400);
  stage.Frames();
  stage.viewer().Set("report", "on");
  stage.Frames();
  ExpectInside("Report");
}

// A slider shows what the pointer is at for as long as it is held, at one scale from end to end of the drag.
TEST(Panels, ASliderFollowsThePointer) {
  for (const char* name : {"exposure", "walk-speed"}) {
    Stage stage(1400, 1600, 1);
    stage.viewer().Set("control-panel", "on");
    stage.viewer().Set(name, "2");  // far from either end of what may be
    stage.Frames();
    ImGui::SetWindowSize(kControl, ImVec2(400, 1500));
    const ImVec2 left = stage.FindField(kControl, stage.Option(name));
    const float middle = ImGui::FindWindowByName(kControl)->WorkRect.Min.x + 60;
    const auto value = [&] { return std::stod(stage.Option(name).get()); };
    stage.Point(middle + 2, left.y);
    ImGui::GetIO().MouseDown[0] = true;
    stage.Frames(60);
    const double first = value();
    EXPECT_NEAR(std::log10(first / 2), 0, 0.25) << name;  // 6 decades on 120 pixels
    stage.Point(middle + 20, left.y);
    const double further = value();
    EXPECT_NEAR(std::log10(further / first), 1, 0.25) << name;
    stage.Frames(60);
    EXPECT_EQ(value(), further) << name;
    stage.Point(middle + 2, left.y);
    EXPECT_EQ(value(), first) << name;
    ImGui::GetIO().MouseDown[0] = false;
    stage.Frames();
    EXPECT_EQ(value(), first) << name;
  }
}

// What is typed into a field is taken when editing ends, by a click elsewhere as by Enter; Escape takes
// nothing.
TEST(Panels, FieldsTakeWhatIsTyped) {
  Stage stage(1400, 1000, 1);
  stage.viewer().Set("parameters", "on");
  stage.Frames();
  const Setting& setting = stage.Option("error-samples");
  const ImVec2 field = stage.FindField("Parameters", setting);
  const auto type = [&](const char* text) {
    stage.DoubleClick(field);  // chooses all of it
    EXPECT_TRUE(Panels::Typing());
    stage.Type(text);
  };
  const auto leave = [&] { stage.Click(1300, 900); };
  type("7");
  leave();
  EXPECT_EQ(setting.get(), "7");
  type("9");
  stage.Press(Stage::kEscape);
  leave();
  EXPECT_EQ(setting.get(), "7");
  type("11");
  stage.Press(Stage::kEnter);
  EXPECT_EQ(setting.get(), "11");
  EXPECT_EQ(stage.viewer().message(), "");
  type("0");
  leave();
  EXPECT_EQ(setting.get(), "11");
  EXPECT_NE(stage.viewer().message(), "");
}

// Text that a field refuses stays in it, and so do the keys: whoever types on presses no shortcuts.
TEST(Panels, ARefusedTextKeepsTheKeys) {
  Stage stage(1400, 1000, 1);
  stage.viewer().Set("parameters", "on");
  stage.Frames();
  const Setting& setting = stage.Option("error-samples");
  stage.DoubleClick(stage.FindField("Parameters", setting));
  stage.Type("0");
  const std::string before = setting.get();
  stage.Press(Stage::kEnter);
  EXPECT_NE(stage.viewer().message(), "");
  EXPECT_TRUE(Panels::Typing());
  EXPECT_EQ(setting.get(), before);
  stage.Type("7");  // in place of what was refused
  stage.Press(Stage::kEnter);
  EXPECT_EQ(setting.get(), "7");
  EXPECT_FALSE(Panels::Typing());
}

// So it is in a dialog, which tells why.
TEST(Panels, ARefusedDialogStaysOpen) {
  Stage stage(640, 480, 1);
  stage.Frames();
  stage.viewer().RunMenu("File/Open...");
  stage.Frames();
  stage.Type("no/such.obj");
  stage.Press(Stage::kEnter);
  EXPECT_EQ(stage.viewer().panels().dialog, "open");
  EXPECT_TRUE(Panels::Typing());
  stage.Press(Stage::kEscape);
  EXPECT_EQ(stage.viewer().panels().dialog, "");
  EXPECT_FALSE(Panels::Typing());
}

// Each new panel opens inside a window of any size, and draws what there is.
TEST(Panels, LampsAndTimeLineOpenInside) {
  for (const auto& [width, height] : {std::pair(1280.0F, 800.0F), std::pair(400.0F, 300.0F)}) {
    Stage stage(width, height, 1);
    stage.viewer().Set("lamps", "on");
    stage.viewer().Set("time-line", "on");
    for (int i = 0; i < 4; ++i) {
      stage.viewer().RunMenu("Iteration/Step");
      while (stage.viewer().status().busy) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      stage.Frames();
    }
    for (const char* panel : {"Lamps and materials", "Time line"}) ExpectInside(panel);
    EXPECT_EQ(stage.viewer().steps()->size(), 4U);
  }
}

// While something is being computed, the button that ends it can be reached in a window of any width, and
// what is done and the rate stand inside where there is any room for them.
TEST(Panels, TheStatusFitsBesideTheMenus) {
  for (const float width : {1280.0F, 800.0F, 700.0F, 500.0F, 300.0F, 150.0F}) {
    ViewerOptions options = Options(false);
    std::atomic<bool> done = false;
    options.files.exports_mesh = [](const std::string&) { return false; };
    options.files.export_file = [&](const std::string&, const Scene&, const IrradianceMesh*, const Camera&) {
      while (!done) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    Stage stage(width, 400, 1, options);
    struct AtEnd {
      std::atomic<bool>& flag;
      ~AtEnd() { flag = true; }
    } const at_end{done};
    stage.viewer().Set("export", "a.obj");
    stage.Frames();
    ASSERT_TRUE(stage.viewer().status().busy);
    ImGuiWindow* bar = ImGui::FindWindowByName("##MainMenuBar");
    const ImGuiID button = ImHashStr("Cancel", 0, bar->GetIDNoKeepAlive("##menubar"));
    const auto cancel = stage.Find(button, ImVec2(0, 9), {4, 0});
    ASSERT_TRUE(cancel) << width;
    EXPECT_LE(cancel->x + ImGui::CalcTextSize("Cancel").x, width) << width;
    if (width >= 300) {
      EXPECT_LE(bar->DC.MenuBarOffset.x - ImGui::GetStyle().ItemSpacing.x, width) << width;
    }
  }
}

// In a window of any size the scale of false colours lies inside, below the menus.
TEST(Panels, TheLegendFits) {
  for (const auto& [width, height, scale] : {std::tuple{1280.0F, 800.0F, 1.0F},
                                             {640.0F, 480.0F, 3.0F},
                                             {300.0F, 140.0F, 2.0F},
                                             {60.0F, 60.0F, 1.0F}}) {
    Stage stage(width, height, scale, Options(true));
    stage.viewer().Set("false-colour", "on");
    for (int i = 0; i < 3000 && !stage.viewer().Idle(); ++i) {
      stage.Frames(1);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    stage.Frames();
    const ImDrawList* drawn = ImGui::GetBackgroundDrawList();
    ASSERT_GT(drawn->VtxBuffer.Size, 300);
    for (const ImDrawVert& vertex : drawn->VtxBuffer) {
      EXPECT_GE(vertex.pos.x, 0) << width << " x " << height;
      EXPECT_LE(vertex.pos.x, width) << width << " x " << height;
      EXPECT_GE(vertex.pos.y, ImGui::GetFrameHeight()) << width << " x " << height;
      EXPECT_LE(vertex.pos.y, height) << width << " x " << height;
    }
  }
}

// The window of the menu that was opened last.
const ImGuiWindow* OpenMenu() {
  const ImVector<ImGuiPopupData>& open = GImGui->OpenPopupStack;
  return open.empty() ? nullptr : open.back().Window;
}

// The last menu can be opened and its first item chosen with the mouse, however narrow the window is.
TEST(Panels, MenusAreReachedInNarrowWindows) {
  for (const float width : {1280.0F, 400.0F, 130.0F}) {
    Stage stage(width, 400, 1);
    stage.Frames();
    stage.Click(12, 8);
    const ImGuiWindow* first = OpenMenu();
    ASSERT_NE(first, nullptr) << width;
    if (width < 600) {  // one menu holds them all, a row each
      stage.Point(first->Pos.x + 12, first->Pos.y + first->Size.y - 14);
    } else {
      float x = 0;
      for (const char* top :
           {"File", "Edit", "Viewing", "Cameras", "Drawing", "Visualisation", "Geometry", "Iteration"})
        x += ImGui::CalcTextSize(top).x + 2 * ImGui::GetStyle().ItemSpacing.x;
      stage.Point(x + 20, 8);
    }
    stage.Frames(30);  // menus open after a while
    const ImGuiWindow* last = OpenMenu();
    ASSERT_NE(last, nullptr) << width;
    EXPECT_FALSE(stage.viewer().panels().help);
    stage.Click(last->Pos.x + 12, last->Pos.y + 14);
    EXPECT_TRUE(stage.viewer().panels().help) << width;
  }
}

// The key that follows a dialog's end is not the dialog's any more.
TEST(Panels, TypingEndsWithItsDialog) {
  Stage stage(640, 480, 1);
  stage.Frames();
  EXPECT_FALSE(Panels::Typing());
  stage.viewer().RunMenu("File/Open...");
  stage.Frames();
  EXPECT_TRUE(Panels::Typing());
  ImGui::GetIO().KeysDown[Stage::kEscape] = true;
  stage.Frames(1);
  EXPECT_TRUE(stage.viewer().panels().dialog.empty());
  EXPECT_FALSE(Panels::Typing());
}

}  // namespace
}  // namespace penumbra::viewer
