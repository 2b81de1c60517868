// display/viewer/user_files.h
//
// What the window remembers from one time to the next, in the folder that the XDG base directory
// specification gives for state: $XDG_STATE_HOME/penumbra, by default ~/.local/state/penumbra.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "display/viewer/viewer.h"
#include "solver/scene/scene.h"

namespace penumbra::viewer {

class UserFiles {
 public:
  // Nothing is read nor written where there is no such folder and none can be made: no home, say.
  UserFiles();

  std::string Read(const std::string& name) const;  // empty if there is none
  void Write(const std::string& name, const std::string& text) const;

  // Scenes that were opened, the latest first.
  std::vector<std::string> Recent() const;
  // Puts a scene first. A path is kept absolute.
  void AddRecent(const std::string& scene) const;

  // Which panels are open, and what opens and closes them so again.
  void KeepPanels(const Viewer& viewer) const;
  void OpenPanels(Viewer* viewer) const;

  // The cameras that were named in a scene, oldest first; the scene as in AddRecent.
  std::vector<Camera> Cameras(const std::string& scene) const;
  // Keeps a camera; another one of its name in that scene goes.
  void KeepCamera(const std::string& scene, const Camera& camera) const;

 private:
  std::optional<std::string> folder_;
};

}  // namespace penumbra::viewer
