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
  void Message(Viewer& viewer);
  void Legend(Viewer& viewer);
  // Runs an action that the user requests. If the action throws an exception, Try() shows the exception's
  // message to the user.
  template <class Action>
  void Try(Viewer& viewer, const Action& action);

  struct PanelPlace {
    PanelRect wanted;                // place and size that the user chose
    PanelRect shown;                 // place and size in the last frame
    std::pair<float, float> window;  // the window's size when the user placed the panel; 0: not placed
  };
  std::map<std::string, PanelPlace> places_;  // place of each panel, by the panel's name
  std::string asked_;                         // name of the open dialog
  char text_[1024] = {};                      // text in the input field of the open dialog
  std::string edited_;                        // the setting whose field the user edits
  char edit_[1024] = {};                      // text in the edited field, for example a path
  std::string unedited_;                      // the field's text before the edit
  std::string slid_;                          // the setting whose slider the user drags
  float slid_low_ = 0, slid_high_ = 1;
};

}  // namespace penumbra::viewer
