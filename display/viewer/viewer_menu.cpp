// The menus of the viewer, after the thesis's Appendix B.

#include "display/viewer/viewer.h"

namespace penumbra::viewer {

void Viewer::AddMenus() {
  const auto add = [this](const std::string& path, const std::string& key, const std::string& help,
                          auto run) {
    menu_.Add({path, key, help, run, {}});
  };
  // An item that switches a setting on and off, or to one of its values.
  const auto toggle = [this](const std::string& path, const std::string& key, const std::string& name) {
    menu_.Add({path, key, settings_.Find(name)->help,
               [this, name] { Set(name, settings_.Find(name)->get() == "on" ? "off" : "on"); },
               [this, name] { return settings_.Find(name)->get() == "on"; }});
  };
  const auto choose = [this](const std::string& path, const std::string& key, const std::string& name,
                             const std::string& value) {
    menu_.Add({path, key, settings_.Find(name)->help + ": " + value,
               [this, name, value] { Set(name, value); },
               [this, name, value] { return settings_.Find(name)->get() == value; }});
  };
  const auto ask = [&](const std::string& path, const std::string& key, const std::string& name) {
    add(path, key, settings_.Find(name)->help, [this, name] { panels_.dialog = name; });
  };

  ask("File/Open...", "ctrl+o", "open");
  ask("File/Save solution...", "ctrl+s", "save-solution");
  ask("File/Save report...", "", "save-report");
  ask("File/Export...", "ctrl+e", "export");
  ask("File/Save picture...", "ctrl+p", "save-picture");
  add("File/Quit", "ctrl+q", "End the program", [this] { panels_.quit = true; });

  choose("Viewing/Arcball", "", "navigation", "arcball");
  choose("Viewing/Walk", "", "navigation", "walk");
  add("Viewing/Arcball or walk", "n", "Change the viewing mode",
      [this] { Set("navigation", view_.navigation == Navigation::kWalk ? "arcball" : "walk"); });
  toggle("Viewing/Mouse look", "ctrl+m", "mouse-look");
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 up(0.0);
    up[axis] = 1;
    menu_.Add({std::string("Viewing/") + "XYZ"[axis] + " up", "", "The direction that is up while walking",
               [this, up] { view_.up_axis = up; }, [this, up] { return view_.up_axis == up; }});
  }
  add("Viewing/Faster", "+", "Walk faster",
      [this] { view_.walk_speed = std::min(2 * view_.walk_speed, 1e4); });
  add("Viewing/Slower", "-", "Walk slower",
      [this] { view_.walk_speed = std::max(view_.walk_speed / 2, 1e-3); });
  add("Viewing/Home", "h", "Back to the first camera", [this] { Home(); });

  ask("Cameras/Save as...", "ctrl+k", "save-camera");

  choose("Drawing/Flat shading", "1", "mode", "flat");
  choose("Drawing/Gouraud shading", "2", "mode", "gouraud");
  choose("Drawing/Gouraud shading with discontinuities", "3", "mode", "gouraud-mesh");
  choose("Drawing/Interpolant rendering", "4", "mode", "interpolant");
  choose("Drawing/Reflectance", "5", "mode", "rho");
  choose("Drawing/Exact irradiance, by rays", "6", "mode", "exact");
  choose("Drawing/Interpolants, by rays", "7", "mode", "lerp");
  choose("Drawing/Passes by the rasteriser", "", "backend", "software");
  choose("Drawing/Passes by OpenGL", "", "backend", "opengl");
  toggle("Drawing/Draw faces", "f", "faces");
  toggle("Drawing/Draw trees using rho", "r", "trees-by-reflectance");
  toggle("Drawing/Split view", "v", "split");
  toggle("Drawing/Automatic exposure", "a", "auto-exposure");
  const auto expose = [this](double factor) {
    Set("exposure", TextOf(std::clamp(factor * picture_.exposure(), 1e-9, 1e9)));
  };
  add("Drawing/Brighter", "]", "Raise the exposure", [expose] { expose(1.25); });
  add("Drawing/Darker", "[", "Lower the exposure", [expose] { expose(0.8); });
  toggle("Drawing/False colours", "o", "false-colour");
  toggle("Drawing/Drawing control panel", "d", "control-panel");

  toggle("Visualisation/Element mesh", "m", "element-mesh");
  add("Visualisation/Mesh one level deeper", ".", "Mesh depth",
      [this] { view_.overlays.mesh_depth = std::min(view_.overlays.mesh_depth + 1, kMaxLevel); });
  add("Visualisation/Mesh one level less deep", ",", "Mesh depth",
      [this] { view_.overlays.mesh_depth = std::max(std::min(view_.overlays.mesh_depth, 8) - 1, 0); });
  toggle("Visualisation/Visible links", "l", "visible-links");
  toggle("Visualisation/Links split by a plane", "k", "split-links");
  toggle("Visualisation/Partial links", "p", "partial-links");
  toggle("Visualisation/Discontinuities", "x", "discontinuities");
  toggle("Visualisation/Triangles", "t", "triangles");
  toggle("Visualisation/Sample points", "s", "sample-points");
  toggle("Visualisation/Representation error", "e", "error-map");
  toggle("Visualisation/Analytic irradiance", "g", "analytic-graph");
  toggle("Visualisation/Interpolated irradiance", "b", "interpolated-graph");
  toggle("Visualisation/Error surface", "j", "error-graph");
  toggle("Visualisation/Dynamic grid density", "", "dynamic-grid");
  toggle("Visualisation/Hidden lines", "u", "hidden-lines");

  add("Geometry/Unselect all", "escape", "Nothing is selected or probed any more", [this] { Unselect(); });
  toggle("Geometry/Draw only what is selected", "z", "isolate");
  toggle("Geometry/Parameters", "ctrl+d", "parameters");

  add("Iteration/Link", "", "Start over: links between patches", [this] { Begin().Link(); });
  add("Iteration/Iterate", "i", "Gather until little changes, then refine, once",
      [this] { Begin().Iterate(); });
  add("Iteration/Iterate to convergence", "c", "Iterate until it is done, then correct", [this] {
    asked_.clear();
    Begin().Converge();
  });
  add("Iteration/Correct", "y", "One pass of exact irradiance over the leaves",
      [this] { Begin().Correct(); });
  add("Iteration/Build interpolants", "", "Discontinuities, triangles and interpolants",
      [this] { Begin().BuildMesh(MeshKind::kInterpolant); });
  add("Iteration/Measure", "", "Energy balance, and errors at random points", [this] {
    panels_.report = true;
    Begin().Measure();
  });
  add("Iteration/Cancel", "backspace", "End what is being computed after its last whole step", [this] {
    if (picture_.Busy()) {
      picture_.CancelRays();
      return;
    }
    asked_.emplace(session_.snapshot()->number, MeshOf(view_.mode));  // nor is it begun now
    session_.Cancel();
  });
  toggle("Iteration/Report", "ctrl+r", "report");

  toggle("Help/Keyboard shortcuts", "?", "help");
  toggle("Help/Details", "ctrl+i", "details");
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
