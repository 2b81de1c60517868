// solver/scene/scene_reader.h
//
// The interface of scene readers. Each kind of source, such as OBJ files, has its own reader.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/base/registry.h"
#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

// The scene that a user has named, with the data by which a reader decides whether it can read the scene.
struct SceneSource {
  std::string name;            // as it was given
  bool is_file = false;        // it is a file, a pipe or a device, but no folder
  std::string_view beginning;  // the first kFormatBytes bytes of a regular file, or fewer
};

class SceneReader {
 public:
  virtual ~SceneReader() = default;

  // The endings of the names of the files that this reader reads, without the dot.
  virtual std::vector<std::string> Endings() const { return {}; }

  // Whether the first bytes of the source show that it is of a format of this reader. Asked first, of all
  // readers: a file is what it contains, whatever its name.
  virtual bool RecognisesContent(const SceneSource& source) const;

  // Whether this reader can read the source. By default, true if the source is a file whose name has one of
  // Endings().
  virtual bool Recognises(const SceneSource& source) const;

  // The scene, including its patches. Throws InputError with the message "NAME:LINE: error: what is wrong and
  // how to mend it".
  virtual Scene Read(const std::string& name, const SceneOptions& options) const = 0;
};

// SceneReaders() holds all readers.
using SceneReaderRegistry = Registry<const SceneReader>;

}  // namespace penumbra
