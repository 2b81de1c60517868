// solver/scene/scene_writer.h
//
// Scenes for other programs: a writer for each format behind one interface.

#pragma once

#include <string>
#include <vector>

#include "solver/base/registry.h"
#include "solver/scene/scene.h"

namespace penumbra {

class SceneWriter {
 public:
  virtual ~SceneWriter() = default;

  // Whether the format holds a camera.
  virtual bool HasCamera() const { return false; }

  // The paths of the files that the format needs beside the one at `path`.
  virtual std::vector<std::string> FilesBeside(const std::string& /*path*/) const { return {}; }

  // What the files hold: those beside, in their order, and at last the one at `path`.
  virtual std::vector<std::string> Texts(const Scene& scene, const Camera& camera,
                                         const std::string& path) const = 0;
};

// SceneWriters() holds all writers. The name of each is the ending of its files.
using SceneWriterRegistry = Registry<const SceneWriter>;

}  // namespace penumbra
