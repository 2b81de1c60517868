// display/viewer/viewer.h
//
// The viewer without its window: what the user does goes in, pictures come out. A window, a script or a test
// drives it, a frame at a time.

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

// What the window shows around the picture.
struct PanelState {
  bool control = false, help = false, details = true, report = false, parameters = false;
  std::string dialog;  // the name of a setting whose value is being asked for; empty: none
  bool quit = false;
};

struct ViewerOptions {
  std::string scene_name;  // as the user gave it
  ViewerFiles files;
  PipelineOptions solving;
  bool solve = true;  // begin at once
  // Where the line of each probe goes.
  std::function<void(const std::string&)> print;
  // Told of each scene that was opened, by its name.
  std::function<void(const std::string&)> opened;
  // The cameras that users named in a scene before, and where one goes that is named now.
  std::function<std::vector<Camera>(const std::string& scene)> kept_cameras;
  std::function<void(const std::string& scene, const Camera& camera)> keep_camera;
};

class Viewer {
 public:
  Viewer(const OpenedScene& opened, ViewerOptions options);

  // A frame: takes over what the solver and the analyses have done since the last, moves a walking camera by
  // `seconds`, and draws width x height pixels. REQUIRES: no context of OpenGL is current in this thread.
  const Srgb8Image& Frame(int width, int height, double seconds);

  // What the user did to the picture, in the order of time.
  void Handle(const InputEvent& event);

  // Runs a menu item, sets a setting. Throws InputError if there is none, or if it cannot be.
  void RunMenu(const std::string& path);
  void Set(const std::string& name, const std::string& value);

  // Nothing is being computed, nor will be, unless the user does something; the last frame shows it all.
  bool Idle();

  const Menu& menu() const { return menu_; }
  const Settings& settings() const { return settings_; }
  const ViewState& view() const { return view_; }
  PanelState& panels() { return panels_; }
  const Snapshot& snapshot() const { return *snapshot_; }
  const PictureMaker& picture() const { return picture_; }
  const std::vector<Camera>& cameras() const { return cameras_; }
  SessionStatus status() const { return session_.status(); }
  // What is going on beside the solver, in a few words.
  std::string activity();
  // What to tell the user: what went wrong last, up to the last frame; empty: nothing.
  const std::string& message() const { return message_; }
  void Dismiss() { message_.clear(); }
  void Complain(const std::string& message) { message_ = message; }
  // What is selected and probed, a line each.
  std::vector<std::string> Details() const;
  const std::string& scene_name() const { return options_.scene_name; }
  const PipelineOptions& solving() const { return options_.solving; }
  double seconds_a_frame() const { return seconds_a_frame_; }
  // The mouse turns the view as it moves, and is for nothing else: no dialog is to be answered.
  bool Looking() const {
    return view_.navigation == Navigation::kWalk && view_.mouse_look && panels_.dialog.empty();
  }

  // Scenes opened before, the latest first.
  void SetRecent(const std::vector<std::string>& names);
  void AddCamera(const Camera& camera);
  // Throws InputError if the camera cannot see.
  void GoTo(const Camera& camera);

 private:
  // viewer_settings.cpp
  void AddViewSettings();
  void AddVisualisationSettings();
  void AddViewingSettings();
  void AddSolveSettings();
  void AddSolveSetting(const SolveOption& option);
  void AddFileSettings();
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
  // viewer_input.cpp
  void KeyDown(const InputEvent& event);
  void ButtonDown(const InputEvent& event);
  void ButtonUp(const InputEvent& event);
  void Move(const InputEvent& event);
  void Click(const InputEvent& event);
  void Walk(double seconds);
  void Probe(const InputEvent& event, bool backproject);

  void Home();

  // viewer_files.cpp
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
  // The session, to begin something that the user asked for: complaints are about what was before, and what
  // it says next is news, even if it is the same.
  SolverSession& Begin();
  void SolvingChanged() { session_.SetOptions(options_.solving); }

  ViewerOptions options_;
  std::optional<PipelineOptions> own_links_;  // while links are given: as one's own would be made
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
  std::string heard_;  // the session's message, once it was told
  std::size_t printed_ = 0;
  std::shared_ptr<const ProbeResult> printed_probe_;
  // Meshes that were asked for, with the snapshot's number: each is once, whether it was cancelled or not.
  std::set<std::pair<std::uint64_t, MeshKind>> asked_;

  // The drawing of the overlays, and what it was made of.
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

  // The pointer.
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
  std::set<std::string> held_;  // keys
  double clock_ = 0;
  double last_click_ = -1, last_click_x_ = 0, last_click_y_ = 0;
  double seconds_a_frame_ = 0;
  bool keep_camera_ = false;  // when the next scene comes
  bool fresh_ = false;        // nothing happened since the last frame
};

}  // namespace penumbra::viewer
