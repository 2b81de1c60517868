// display/viewer/user_files.h
//
// Files that store the window's state until the next run of the program. The files are in the state folder of
// the XDG base directory specification: $XDG_STATE_HOME/penumbra, by default ~/.local/state/penumbra.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "display/viewer/viewer.h"
#include "solver/scene/scene.h"

namespace penumbra::viewer {

class UserFiles {
 public:
  // If the folder does not exist and cannot be created, for example without a home folder, the object neither
  // reads nor writes.
  UserFiles();

  std::string Read(const std::string& name) const;  // empty if there is no such file
  void Write(const std::string& name, const std::string& text) const;

  // The paths or names of the scenes that were opened, in reverse order of time.
  std::vector<std::string> Recent() const;
  // Adds a scene at the front of the list Recent(), or moves it there. Paths are stored as absolute paths.
  void AddRecent(const std::string& scene) const;

  // KeepPanels() writes to a file which panels of the window are open. OpenPanels() reads the file, and opens
  // and closes the panels accordingly.
  void KeepPanels(const Viewer& viewer) const;
  void OpenPanels(Viewer* viewer) const;

  // The cameras of a scene that the user has named, the oldest first. `scene` is a path or name, as for
  // AddRecent().
  std::vector<Camera> Cameras(const std::string& scene) const;
  // Stores a camera. The new camera replaces a stored camera with the same name in the same scene.
  void KeepCamera(const std::string& scene, const Camera& camera) const;

 private:
  std::optional<std::string> folder_;
};

}  // namespace penumbra::viewer
