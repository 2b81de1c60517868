// display/viewer/viewer.h
//
// The class Viewer is the viewer without its window: a Viewer receives user input and makes pictures. A
// window, a script or a test drives the viewer, one frame after another.

#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "display/viewer/analyses.h"
#include "display/viewer/arcball.h"
#include "display/viewer/input.h"
#include "display/viewer/menu.h"
#include "display/viewer/opened_scene.h"
#include "display/viewer/picture.h"
#include "display/viewer/settings.h"
#include "display/viewer/solver_session.h"
#include "display/viewer/view_state.h"
#include "mesh/pipeline/option_table.h"

namespace penumbra::viewer {

// The state of the panels and dialogs around the viewer's picture.
struct PanelState {
  bool control = false, help = false, details = true, report = false, parameters = false;
  std::string dialog;  // the setting whose value the open dialog requests; empty: no dialog is open
  bool quit = false;
};

struct ViewerOptions {
  std::string scene_name;  // name of the scene as the user gave it
  ViewerFiles files;
  PipelineOptions solving;
  bool solve = true;  // if true, solving starts when the scene is opened
  // A function that receives the CSV line of each irradiance probe.
  std::function<void(const std::string&)> print;
  // A function that receives the name of each opened scene.
  std::function<void(const std::string&)> opened;
  // kept_cameras() returns the cameras that the user has named in a scene in earlier runs; keep_camera()
  // stores a camera that the user has just named.
  std::function<std::vector<Camera>(const std::string& scene)> kept_cameras;
  std::function<void(const std::string& scene, const Camera& camera)> keep_camera;
};

class Viewer {
 public:
  Viewer(const OpenedScene& opened, ViewerOptions options);

  // Makes one frame of width x height pixels, with the newest results of the solver and of analyses. In walk
  // mode, Frame() moves the camera by the distance that the user walks in the time `seconds`. REQUIRES: no
  // OpenGL context is current in the calling thread.
  const Srgb8Image& Frame(int width, int height, double seconds);

  // Processes one event of user input on the picture. Input events must be passed to Handle() in the order of
  // time.
  void Handle(const InputEvent& event);

  // RunMenu() runs a menu item; Set() changes the value of a setting. RunMenu() and Set() throw InputError if
  // the menu item or setting does not exist, or if the action fails.
  void RunMenu(const std::string& path);
  void Set(const std::string& name, const std::string& value);

  // True if no computation is running, no computation will start without user input, and the last frame shows
  // all results.
  bool Idle();

  const Menu& menu() const { return menu_; }
  const Settings& settings() const { return settings_; }
  const ViewState& view() const { return view_; }
  PanelState& panels() { return panels_; }
  const Snapshot& snapshot() const { return *snapshot_; }
  const PictureMaker& picture() const { return picture_; }
  const std::vector<Camera>& cameras() const { return cameras_; }
  SessionStatus status() const { return session_.status(); }
  // A few words for the status line about the state of the viewer while the solver is idle, for example
  // "ready" or "analysing".
  std::string activity();
  // The message for the user: the last error that occurred before the last frame; empty if no error occurred.
  const std::string& message() const { return message_; }
  void Dismiss() { message_.clear(); }
  void Complain(const std::string& message) { message_ = message; }
  // Descriptions of the selected object and of the probed points, one string per line.
  std::vector<std::string> Details() const;
  const std::string& scene_name() const { return options_.scene_name; }
  const PipelineOptions& solving() const { return options_.solving; }
  double seconds_a_frame() const { return seconds_a_frame_; }
  // True if mouse movements only turn the view: in walk mode with mouse look, while no dialog is open.
  bool Looking() const {
    return view_.navigation == Navigation::kWalk && view_.mouse_look && panels_.dialog.empty();
  }

  // Sets the list of recently opened scenes, the latest first.
  void SetRecent(const std::vector<std::string>& names);
  void AddCamera(const Camera& camera);
  // Shows the scene from another camera. Throws InputError if ValidateCamera() rejects the camera.
  void GoTo(const Camera& camera);

 private:
  // The following functions are defined in viewer_settings.cpp.
  void AddViewSettings();
  void AddVisualisationSettings();
  void AddViewingSettings();
  void AddSolveSettings();
  void AddSolveSetting(const SolveOption& option);
  void AddFileSettings();
  // The following functions are defined in viewer_menu.cpp.
  void AddMenus();
  void AddFileMenu();
  void AddViewingMenu();
  void AddDrawingMenu();
  void AddOverlayMenu();
  void AddIterationMenu();
  void Item(const std::string& path, const std::string& key, const std::string& help,
            std::function<void()> run);
  void ToggleItem(const std::string& path, const std::string& key, const std::string& name);
  void ChoiceItem(const std::string& path, const std::string& key, const std::string& name,
                  const std::string& value);
  void AskItem(const std::string& path, const std::string& key, const std::string& name);
  void AddCameraMenu();
  // The following functions are defined in viewer_input.cpp.
  void KeyDown(const InputEvent& event);
  void ButtonDown(const InputEvent& event);
  void ButtonUp(const InputEvent& event);
  void Move(const InputEvent& event);
  void Click(const InputEvent& event);
  void Walk(double seconds);
  void Probe(const InputEvent& event, bool backproject);

  void Home();

  // The following functions are defined in viewer_files.cpp.
  void AddSceneSettings();
  void Take(const OpenedScene& opened);
  void TakeOptions(const OpenedScene& opened);
  void Open(const std::string& name);
  void SaveCamera(const std::string& name);
  void SavePicture(const std::string& path);
  void SaveLargerPicture(const std::string& path, int k);
  void SaveRayPicture(const std::string& path);
  void SaveSolved(const std::string& path, const ViewerFiles::WriteSolved& write);
  void Export(const std::string& path);
  void ListCameras();

  void Unselect();
  void Want(MeshKind kind);
  std::shared_ptr<const MeshState> ToolsMesh() const;
  OverlayContext Context() const;
  void AskForMeshes();
  void DrawOverlays();
  void HearSession();
  bool HasNews() const;
  // Returns the solver session, for a task that the user requests. Begin() also discards older messages, so
  // that the next message of the solver session is shown even if it equals the last shown message.
  SolverSession& Begin();
  void SolvingChanged() { session_.SetOptions(options_.solving); }

  ViewerOptions options_;
  // the options for the scene's own links, set while links of another solution are used
  std::optional<PipelineOptions> own_links_;
  SolverSession session_;
  std::shared_ptr<const Snapshot> snapshot_;
  std::shared_ptr<const MeshState> tools_;
  ViewState view_;
  PanelState panels_;
  std::vector<Camera> cameras_;
  Settings settings_;
  Menu menu_;
  Analyses analyses_;
  AnalysisResults results_;
  PictureMaker picture_;
  std::string message_;
  std::string heard_;  // the last message of the solver session that was shown
  std::size_t printed_ = 0;
  std::shared_ptr<const ProbeResult> printed_probe_;
  // The kinds of meshes that were requested, each with the number of the Snapshot (state of the solution) to
  // which the mesh belongs. The viewer requests a mesh only once per Snapshot, even if the computation was
  // cancelled.
  std::set<std::pair<std::uint64_t, MeshKind>> asked_;

  // The latest drawing of the overlays, and the data from which the drawing was made.
  OverlayDrawing drawing_;
  struct DrawnOf {
    std::shared_ptr<const Snapshot> snapshot;
    std::shared_ptr<const MeshState> tools;
    OverlaySettings settings;
    Selection selection;
    bool isolate = false;
    AnalysisResults results;
    bool operator==(const DrawnOf&) const = default;
  };
  std::optional<DrawnOf> drawn_of_;

  // The state of the mouse pointer.
  PictureSize size_{640, 480};
  double x_ = 0, y_ = 0;
  struct Press {
    MouseButton button;
    double x, y;
    unsigned modifiers;
    bool moved = false;
  };
  std::optional<Press> press_;
  std::optional<ArcballDrag> drag_;
  Camera press_camera_;
  std::set<std::string> held_;  // keys held down
  double clock_ = 0;
  double last_click_ = -1, last_click_x_ = 0, last_click_y_ = 0;
  double seconds_a_frame_ = 0;
  bool keep_camera_ = false;  // if true, the next opened scene keeps the present camera
  bool fresh_ = false;        // true if no user input has arrived since the last frame
};

}  // namespace penumbra::viewer
