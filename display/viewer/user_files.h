// display/viewer/user_files.h
//
// Files that store the state of the viewer's window until the next run of the program. The state files are in
// the state folder of the XDG base directory specification: $XDG_STATE_HOME/penumbra, by default
// ~/.local/state/penumbra.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "display/viewer/viewer.h"
#include "solver/scene/scene.h"

namespace penumbra::viewer {

class UserFiles {
 public:
  // If the state folder does not exist and cannot be created, for example without a home folder, the
  // UserFiles object neither reads nor writes files.
  UserFiles();

  // the text of a state file; empty if the file does not exist
  std::string Read(const std::string& name) const;
  void Write(const std::string& name, const std::string& text) const;

  // The paths or names of recently opened scenes, the latest first.
  std::vector<std::string> Recent() const;
  // Adds a scene at the front of the list Recent(), or moves the scene to the front. Paths of scenes are
  // stored as absolute paths.
  void AddRecent(const std::string& scene) const;

  // KeepPanels() writes to a file which panels of the window are open. OpenPanels() reads this file, and
  // opens and closes the panels accordingly.
  void KeepPanels(const Viewer& viewer) const;
  void OpenPanels(Viewer* viewer) const;

  // The cameras that the user has named in a scene, the oldest first. `scene` is a path or name, as for
  // AddRecent().
  std::vector<Camera> Cameras(const std::string& scene) const;
  // Stores a named camera of a scene. The new camera replaces a stored camera with the same name in the same
  // scene.
  void KeepCamera(const std::string& scene, const Camera& camera) const;

 private:
  std::optional<std::string> folder_;
};

}  // namespace penumbra::viewer
