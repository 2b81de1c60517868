// The menus of the viewer, after the thesis's Appendix B.

#include "display/viewer/overlays.h"
#include "display/viewer/viewer.h"

namespace penumbra::viewer {

void Viewer::Item(const std::string& path, const std::string& key, const std::string& help,
                  std::function<void()> run) {
  menu_.Add({path, key, help, std::move(run), {}});
}

// An item that switches a setting on and off,
void Viewer::ToggleItem(const std::string& path, const std::string& key, const std::string& name) {
  menu_.Add({path, key, settings_.Find(name)->help,
             [this, name] { Set(name, settings_.Find(name)->get() == "on" ? "off" : "on"); },
             [this, name] { return settings_.Find(name)->get() == "on"; }});
}

// sets it to one of its values,
void Viewer::ChoiceItem(const std::string& path, const std::string& key, const std::string& name,
                        const std::string& value) {
  menu_.Add({path, key, settings_.Find(name)->help + ": " + value, [this, name, value] { Set(name, value); },
             [this, name, value] { return settings_.Find(name)->get() == value; }});
}

// or asks for its value.
void Viewer::AskItem(const std::string& path, const std::string& key, const std::string& name) {
  Item(path, key, settings_.Find(name)->help, [this, name] { panels_.dialog = name; });
}

void Viewer::AddMenus() {
  AddFileMenu();
  AddHistoryMenu();
  AddViewingMenu();
  AskItem("Cameras/Save as...", "ctrl+k", "save-camera");
  AddDrawingMenu();
  AddOverlayMenu();
  Item("Geometry/Unselect all", "escape", "Nothing is selected or probed any more", [this] { Unselect(); });
  ToggleItem("Geometry/Draw only what is selected", "z", "isolate");
  AddPartMenu();
  ToggleItem("Geometry/Parameters", "ctrl+d", "parameters");
  AddIterationMenu();
  ToggleItem("Help/Keyboard shortcuts", "?", "help");
  ToggleItem("Help/Details", "ctrl+i", "details");
  ToggleItem("Help/What is under the pointer", "", "hover");
}

void Viewer::AddFileMenu() {
  AskItem("File/Open...", "ctrl+o", "open");
  AskItem("File/Save solution...", "ctrl+s", "save-solution");
  AskItem("File/Save report...", "", "save-report");
  AskItem("File/Export...", "ctrl+e", "export");
  AskItem("File/Save picture...", "ctrl+p", "save-picture");
  Item("File/Quit", "ctrl+q", "End the program", [this] { AskToQuit(); });
  Item("File/Quit without saving", "", "End the program, and ask nothing", [this] { panels_.quit = true; });
}

void Viewer::AddViewingMenu() {
  ChoiceItem("Viewing/Arcball", "", "navigation", "arcball");
  ChoiceItem("Viewing/Walk", "", "navigation", "walk");
  Item("Viewing/Arcball or walk", "n", "Change the viewing mode",
       [this] { Set("navigation", view_.navigation == Navigation::kWalk ? "arcball" : "walk"); });
  ToggleItem("Viewing/Mouse look", "ctrl+m", "mouse-look");
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 up(0.0);
    up[axis] = 1;
    menu_.Add({std::string("Viewing/") + "XYZ"[axis] + " up", "", "The direction that is up while walking",
               [this, up] { view_.up_axis = up; }, [this, up] { return view_.up_axis == up; }});
  }
  Item("Viewing/Faster", "+", "Walk faster",
       [this] { view_.walk_speed = std::min(2 * view_.walk_speed, 1e4); });
  Item("Viewing/Slower", "-", "Walk slower",
       [this] { view_.walk_speed = std::max(view_.walk_speed / 2, 1e-3); });
  Item("Viewing/Home", "h", "Back to the first camera", [this] { Home(); });
}

void Viewer::AddDrawingMenu() {
  ChoiceItem("Drawing/Flat shading", "1", "mode", "flat");
  ChoiceItem("Drawing/Gouraud shading", "2", "mode", "gouraud");
  ChoiceItem("Drawing/Gouraud shading with discontinuities", "3", "mode", "gouraud-mesh");
  ChoiceItem("Drawing/Interpolant rendering", "4", "mode", "interpolant");
  ChoiceItem("Drawing/Reflectance", "5", "mode", "rho");
  ChoiceItem("Drawing/Exact irradiance, by rays", "6", "mode", "exact");
  ChoiceItem("Drawing/Interpolants, by rays", "7", "mode", "lerp");
  ChoiceItem("Drawing/Means at vertices, by rays", "", "mode", "nodal");
  ChoiceItem("Drawing/Gouraud shading on the screen, by rays", "", "mode", "gouraud-screen");
  ChoiceItem("Drawing/Bilinear pieces, by rays", "", "mode", "bilinear");
  ChoiceItem("Drawing/Bicubic pieces, by rays", "", "mode", "bicubic");
  ChoiceItem("Drawing/Passes by the rasteriser", "", "backend", "software");
  ChoiceItem("Drawing/Passes by OpenGL", "", "backend", "opengl");
  ToggleItem("Drawing/Draw faces", "f", "faces");
  ToggleItem("Drawing/Draw trees using rho", "r", "trees-by-reflectance");
  ToggleItem("Drawing/Split view", "v", "split");
  ToggleItem("Drawing/Automatic exposure", "a", "auto-exposure");
  const auto expose = [this](double factor) {
    Set("exposure", TextOf(std::clamp(factor * picture_.exposure(), 1e-9, 1e9)));
  };
  Item("Drawing/Brighter", "]", "Raise the exposure", [expose] { expose(1.25); });
  Item("Drawing/Darker", "[", "Lower the exposure", [expose] { expose(0.8); });
  ToggleItem("Drawing/False colours", "o", "false-colour");
  ToggleItem("Drawing/Drawing control panel", "d", "control-panel");
  ToggleItem("Drawing/Lamps and materials", "ctrl+l", "lamps");
}

void Viewer::AddOverlayMenu() {
  const auto visualise = [&](const Overlay& overlay) {
    for (const OverlaySwitch& part : overlay.Switches())
      ToggleItem("Visualisation/" + part.menu, part.key, part.name);
    overlay.AddMenuItems(&view_.overlays, &menu_);
  };
  const auto overlays = MakeOverlays();
  const auto is_graph = [](const Overlay& overlay) { return overlay.Group() == "Graphs"; };
  for (const auto& overlay : overlays)
    if (!is_graph(*overlay)) visualise(*overlay);
  ToggleItem("Visualisation/Representation error", "e", "error-map");
  for (const auto& overlay : overlays)
    if (is_graph(*overlay)) visualise(*overlay);
  Item("Visualisation/Keep for comparison", "alt+k", "Keep this state, to compare others with it",
       [this] { comparison_.Keep(snapshot_); });
  ToggleItem("Visualisation/Compare with what was kept", "alt+c", "compare");
  Item("Visualisation/Plot over a line", "ctrl+g", "Two clicks on a face draw the line", [this] {
    draws_line_ = true;
    line_start_.reset();
  });
  ToggleItem("Visualisation/Hidden lines", "u", "hidden-lines");
}

void Viewer::AddIterationMenu() {
  Item("Iteration/Link", "", "Start over: links between patches", [this] {
    stepping_ = false;
    Change().Link();
  });
  Item("Iteration/Iterate", "i", "Gather until little changes, then refine, once", [this] {
    stepping_ = false;
    Change().Iterate();
  });
  Item("Iteration/Iterate to convergence", "c", "Iterate until it is done, then correct", [this] {
    asked_.clear();
    stepping_ = playing_ = false;
    Change().Converge();
  });
  Item("Iteration/Correct", "y", "One pass of exact irradiance over the leaves", [this] {
    stepping_ = false;
    Change().Correct();
  });
  Item("Iteration/Build interpolants", "", "Discontinuities, triangles and interpolants", [this] {
    stepping_ = false;
    Change().BuildMesh(MeshKind::kInterpolant);
  });
  AddStepMenu();
  Item("Iteration/Measure", "", "Energy balance, and errors at random points", [this] {
    panels_.report = true;
    Begin().Measure();
  });
  Item("Iteration/Cancel", "backspace", "End what is being computed after its last whole step", [this] {
    playing_ = false;
    if (picture_.Busy()) {
      picture_.CancelRays();
      return;
    }
    asked_.emplace(session_.snapshot()->number,
                   MeshOf(view_.mode));  // nor is it begun now
    session_.Cancel();
  });
  ToggleItem("Iteration/Report", "ctrl+r", "report");
}

void Viewer::AddCameraMenu() {
  std::vector<MenuItem> items;
  for (const Camera& camera : cameras_)
    items.push_back({"Cameras/Go to/" + camera.name,
                     "",
                     "Look through this camera",
                     [this, camera] { GoTo(camera); },
                     {}});
  menu_.Replace("Cameras/Go to", std::move(items));
}

void Viewer::SetRecent(const std::vector<std::string>& names) {
  std::vector<MenuItem> items;
  for (const std::string& name : names)
    items.push_back({"File/Recent/" + name, "", "Open it again", [this, name] { Open(name); }, {}});
  menu_.Replace("File/Recent", std::move(items));
}

}  // namespace penumbra::viewer
