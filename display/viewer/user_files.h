// display/viewer/user_files.h
//
// Files that keep the window's state from one run to the next, in the state folder of the XDG base directory
// specification: $XDG_STATE_HOME/penumbra, by default ~/.local/state/penumbra.

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

  // The scenes that were opened, the latest first.
  std::vector<std::string> Recent() const;
  // Moves a scene to the front. Paths are stored as absolute paths.
  void AddRecent(const std::string& scene) const;

  // Stores which panels are open, and opens the stored panels.
  void KeepPanels(const Viewer& viewer) const;
  void OpenPanels(Viewer* viewer) const;

  // The named cameras of a scene, the oldest first; `scene` as in AddRecent().
  std::vector<Camera> Cameras(const std::string& scene) const;
  // Stores a camera, in place of a camera with the same name in the same scene.
  void KeepCamera(const std::string& scene, const Camera& camera) const;

 private:
  std::optional<std::string> folder_;
};

}  // namespace penumbra::viewer
