// display/viewer/panels.h

#pragma once

#include "display/viewer/viewer.h"

namespace penumbra::viewer {

// Draws menus and panels with Dear ImGui, and runs what the user does with them. REQUIRES: within a frame of
// ImGui.
// The letters' height where nothing is enlarged [pixels]; panels grow with them.
inline constexpr float kPlainFontSize = 13;

class Panels {
 public:
  void Draw(Viewer& viewer);

 private:
  void MenuBar(Viewer& viewer);
  void Status(Viewer& viewer);
  void Group(Viewer& viewer, const std::string& group);
  void Widget(Viewer& viewer, const Setting& setting);
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

  std::string asked_;     // the dialog that is open
  char text_[1024] = {};  // in its field
  std::string edited_;    // the setting whose field is being edited
  char edit_[128] = {};
};

}  // namespace penumbra::viewer
