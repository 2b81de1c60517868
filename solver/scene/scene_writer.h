// solver/scene/scene_writer.h
//
// The interface of scene writers, which export scenes to other programs. Each file format has its own writer.

#pragma once

#include <string>
#include <vector>

#include "solver/base/registry.h"
#include "solver/scene/scene.h"

namespace penumbra {

class SceneWriter {
 public:
  virtual ~SceneWriter() = default;

  // True if files of the writer's format contain a camera.
  virtual bool HasCamera() const { return false; }

  // The paths of further files that the file format needs in addition to the file at `path`.
  virtual std::vector<std::string> FilesBeside(const std::string& /*path*/) const { return {}; }

  // The contents of all files that are written: first the files FilesBeside(path), in the same order, then
  // the file at `path`.
  virtual std::vector<std::string> Texts(const Scene& scene, const Camera& camera,
                                         const std::string& path) const = 0;
};

// The registry of scene writers; SceneWriters() holds all writers. The name of a writer is the ending of its
// files, without the dot.
using SceneWriterRegistry = Registry<const SceneWriter>;

}  // namespace penumbra
