// display/viewer/panels.h

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "display/viewer/viewer.h"

namespace penumbra::viewer {

// The letters' height where nothing is enlarged [pixels]; panels grow with them.
inline constexpr float kPlainFontSize = 13;

// Where a panel is [pixels].
struct PanelRect {
  float left = 0, top = 0, width = 0, height = 0;
  bool operator==(const PanelRect&) const = default;
};

// Draws menus and panels with Dear ImGui, and runs what the user does with them.
class Panels {
 public:
  // REQUIRES: within a frame of ImGui.
  void Draw(Viewer& viewer);

  // Whether keys belong to a field that is being edited. ImGui's WantTextInput tells two frames after the
  // end.
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
  // Runs it; what it throws is shown.
  template <class Action>
  void Try(Viewer& viewer, const Action& action);

  struct PanelPlace {
    PanelRect wanted;                // where the user had it
    PanelRect shown;                 // where it was in the last frame
    std::pair<float, float> window;  // the window's size when it was put there; 0: never yet
  };
  std::map<std::string, PanelPlace> places_;  // by the panel's name
  std::string asked_;                         // the dialog that is open
  char text_[1024] = {};                      // in its field
  std::string edited_;                        // the setting whose field is being edited
  char edit_[1024] = {};                      // in that field: a path, say
  std::string unedited_;                      // what it showed before
  std::string slid_;                          // the setting whose slider is held
  float slid_low_ = 0, slid_high_ = 1;
};

}  // namespace penumbra::viewer
