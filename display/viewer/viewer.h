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
#include "display/viewer/comparison.h"
#include "display/viewer/history.h"
#include "display/viewer/input.h"
#include "display/viewer/light_change.h"
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
  bool lamps = false, steps = false, hover = true, outline = false;
  std::string dialog;  // the setting whose value a dialog requests; empty: no dialog
  // The question that the window asks before unsaved work is lost; empty if it asks none.
  std::string question;
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
  // A dragged slider sets its value again and again, which is one action for undo: `merge` is then true from
  // the second time on.
  void Set(const std::string& name, const std::string& value, bool merge = false);
  // Takes back the last action, or does again what was taken back: settings, lamps, solver steps, opened
  // scenes; not the camera. No effect if there is none.
  void Undo();
  void Redo();
  std::string UndoLabel() const { return history_.UndoLabel(); }
  std::string RedoLabel() const { return history_.RedoLabel(); }

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
  std::shared_ptr<const std::vector<StepRecord>> steps() const { return session_.steps(); }
  std::size_t step() const { return session_.place()->step; }
  bool playing() const { return playing_; }
  const LightChange& light() const { return light_; }
  // The scene as it was opened, before its light was changed.
  std::shared_ptr<const Scene> opened() const { return session_.place()->opened; }
  // A few words about running computations other than the solver's.
  std::string activity();
  // The message for the user: the last error that occurred before the last frame; empty if no error occurred.
  const std::string& message() const { return message_; }
  void Dismiss() { message_.clear(); }
  void Complain(const std::string& message) { message_ = message; }
  // One line about what is under the pointer: face, material, light, triangle; empty over the background.
  std::string Hover() const;
  std::shared_ptr<const LinePlot> line_plot() const { return results_.line_plot; }
  // Descriptions of the selection and the probes, one string per line.
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
  // What undo brings back.
  struct UserState {
    ShownState shown;
    PipelineOptions solving;
    std::optional<PipelineOptions> own_links;
    LightChange light;
    std::string scene_name;
    // The function that brings back how the scene was read (ViewerFiles::keep_reading).
    std::function<void()> reading;
    // The solver's state before the action; null if the action did not touch the solver.
    std::shared_ptr<const SolverPlace> place;
  };

  // viewer_settings.cpp
  void AddViewSettings();
  void AddVisualisationSettings();
  void AddViewingSettings();
  void AddSolveSettings();
  void AddSolveSetting(const SolveOption& option);
  void AddFileSettings();
  // viewer_light.cpp
  void AddLightSettings();
  void ChangeLight(LightChange next);
  // viewer_steps.cpp
  void AddStepSettings();
  // viewer_parts.cpp
  void AddPartSettings();
  void AddPartMenu();
  void SelectPart(const std::string& text);
  void SelectPatch(PatchId patch);
  std::set<std::int32_t> SelectedObjects() const;
  void FrameSelection();
  void AddStepMenu();
  void StepOn();
  void GoToStep(std::size_t number);
  void Play();
  // viewer_history.cpp
  UserState Now(bool with_place) const;
  bool Differs(const UserState& before) const;
  void Restore(const UserState& state);
  template <class Action>
  void Do(const std::string& label, bool merge, const Action& action);
  void Remember(const std::string& label, UserState before);
  SolverSession& Change();
  void AddHistoryMenu();
  void AskToQuit();
  // viewer_menu.cpp
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
  void DrawLine(const ProbedPoint& at);

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
  void SaveLine(const std::string& path);
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
  std::string heard_;  // the last message of the solver session that the window has shown
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
  std::set<std::string> held_;  // the names of the keys that the user holds down
  double clock_ = 0;
  double last_click_ = -1, last_click_x_ = 0, last_click_y_ = 0;
  double seconds_a_frame_ = 0;
  bool keep_camera_ = false;  // if true, the camera stays where it is when the next scene opens
  bool fresh_ = false;        // true if nothing has happened since the last frame was drawn

  History<UserState> history_;
  int depth_ = 0;         // the nesting depth of actions; the outermost action is the user's
  bool changes_ = false;  // true if the present action changes the state of the solver
  LightChange light_;
  // The light whose transport matrix has been requested, for dimming its lamps.
  std::shared_ptr<const LightState> ready_for_light_;
  Comparison comparison_;
  bool compares_ = false;
  // The place of the border between two compared pictures, as a fraction of the width.
  double compare_at_ = 0.5;
  double ask_above_ = 10;  // the window asks before it drops more than this much unsaved work [s]
  // True if the user makes the solver's steps one by one, so that meshes are made only on request.
  bool stepping_ = false;
  std::size_t wanted_step_ = 0;  // the step of the time line to which the user went last
  bool playing_ = false;         // true if the solver makes step after step
  // True if the next clicks set the end points of the line over which light is plotted.
  bool draws_line_ = false;
  std::optional<ProbedPoint> line_start_;
};

}  // namespace penumbra::viewer
