// display/viewer/panels.h

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "display/viewer/viewer.h"

namespace penumbra::viewer {

// The font size of panels on a screen without scaling [pixels]. The size of panels is proportional to the
// font size.
inline constexpr float kPlainFontSize = 13;

// The position and size of a panel [pixels].
struct PanelRect {
  float left = 0, top = 0, width = 0, height = 0;
  bool operator==(const PanelRect&) const = default;
};

// Draws the viewer's menus and panels with Dear ImGui, and runs the user's commands.
class Panels {
 public:
  // Draws all menus and panels. REQUIRES: a frame of ImGui has been started and not ended.
  void Draw(Viewer& viewer);

  // True while the user edits a text field that receives the key presses. Typing() is used instead of ImGui's
  // WantTextInput, because WantTextInput remains true for two frames after the end of the edit.
  static bool Typing();
  // True if keys belong to a panel: while the user types, and while a dialog or a question waits for him.
  // What is typed then never reaches the picture.
  bool WantsKeys(Viewer& viewer) const;
  // True for the few frames until a field that opens, or whose text was refused, receives the keys. Keys must
  // wait until then.
  bool IsOpening(Viewer& viewer) const;

 private:
  bool BeginPanel(const char* name, const PanelRect& first, bool* open);
  void MenuBar(Viewer& viewer);
  static void Menus(const Viewer& viewer, std::string* run);
  void Status(Viewer& viewer);
  void Group(Viewer& viewer, std::string_view group);
  void Widget(Viewer& viewer, const Setting& setting);
  std::string Slider(const Setting& setting, const std::string& label, const std::string& value);
  void Field(Viewer& viewer, const Setting& setting, const std::string& label, const std::string& value);
  void EndEdit(Viewer& viewer);
  void ControlPanel(Viewer& viewer);
  void Parameters(Viewer& viewer);
  void Details(Viewer& viewer);
  void Report(Viewer& viewer);
  void Help(Viewer& viewer);
  void Dialog(Viewer& viewer);
  void DialogField(Viewer& viewer, const Setting& setting);
  void Question(Viewer& viewer);
  void Lamps(Viewer& viewer);  // lamps_panel.cpp
  void LampRow(Viewer& viewer, const Lamp& lamp);
  void PaintRow(Viewer& viewer, const Material& material);
  static void Run(Viewer& viewer, const std::string& menu);
  static void Change(Viewer& viewer, const char* setting, const std::string& value, bool merge);
  void Outline(Viewer& viewer);  // outline_panel.cpp
  void OutlineObject(Viewer& viewer, std::size_t object, std::int64_t selected_object,
                     std::int64_t selected_face);
  void LinePanel(Viewer& viewer);  // line_panel.cpp
  void Hover(Viewer& viewer);
  void TimeLine(Viewer& viewer);  // time_line_panel.cpp
  void Message(Viewer& viewer);
  void Legend(Viewer& viewer);
  // Runs the action. If the action throws an exception, shows the exception's message to the user and returns
  // false.
  template <class Action>
  static bool Try(Viewer& viewer, const Action& action);

  struct PanelPlace {
    PanelRect wanted;  // the place and size of the panel that the user chose
    PanelRect shown;   // the place and size of the panel in the last frame
    // The size of the window when the user placed the panel; 0 if the user never placed it.
    std::pair<float, float> window;
  };
  std::map<std::string, PanelPlace> places_;  // the place of each panel, under the name of the panel
  std::string asked_;                         // the name of the dialog that is open
  char text_[1024] = {};                      // the text in the input field of the open dialog
  std::string edited_;                        // the setting whose field the user edits
  char edit_[1024] = {};                      // text in the edited field, for example a path
  std::string unedited_;                      // the text of the edited field before the user began to edit
  std::string slid_;                          // the setting whose slider the user drags
  float slid_low_ = 0, slid_high_ = 1;
  bool slides_on_ = false;  // true if the present drag of a slider has set a value before
  std::string refused_;     // the setting whose field keeps the keyboard because its text was refused
  char search_[256] = {};   // the text that the user searches for in the outline of the scene
  std::string refusal_;     // the reason why the text in the dialog was refused
  // The factors of lamps before the user switched them off in the panel.
  std::map<std::string, Rgb> factors_before_off_;
  // The lamp or the material whose slider or colour the user drags.
  std::string dragged_;
};

}  // namespace penumbra::viewer
