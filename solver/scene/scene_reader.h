// solver/scene/scene_reader.h
//
// How scenes are read: a reader for each kind of source behind one interface.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/base/registry.h"
#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

// What a user named, as a reader looks at it.
struct SceneSource {
  std::string name;            // as it was given
  bool is_file = false;        // it is a file, a pipe or a device, but no folder
  std::string_view beginning;  // the first kFormatBytes bytes of a regular file, or fewer
};

class SceneReader {
 public:
  virtual ~SceneReader() = default;

  // The endings of the files that it reads, without the dot.
  virtual std::vector<std::string> Endings() const { return {}; }

  // Whether it is the one to read the source. If not overridden: whether the source is a file with one of its
  // endings.
  virtual bool Recognises(const SceneSource& source) const;

  // The scene, its patches built. Throws InputError, with a line "NAME:LINE: error: what is wrong and how to
  // mend it".
  virtual Scene Read(const std::string& name, const SceneOptions& options) const = 0;
};

// SceneReaders() holds all readers.
using SceneReaderRegistry = Registry<const SceneReader>;

}  // namespace penumbra
