// solver/scene/scene_reader.h
//
// The interface of scene readers. Each kind of scene source, such as OBJ files, has its own reader.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/base/registry.h"
#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

// The scene that a user has named, with the data by which a scene reader decides whether it can read the
// scene.
struct SceneSource {
  std::string name;            // the name of the scene as the user gave it
  bool is_file = false;        // true if the name is that of a file, a pipe or a device, but not of a folder
  std::string_view beginning;  // the first bytes of a regular file, at most kFormatBytes
};

class SceneReader {
 public:
  virtual ~SceneReader() = default;

  // The endings, without the dot, of the names of the files that the reader reads.
  virtual std::vector<std::string> Endings() const { return {}; }

  // True if the first bytes of the source show a file format that the reader reads. The program calls
  // RecognisesContent() of all readers before it calls Recognises() of any reader, because the content of a
  // file, not its name, determines the file's format.
  virtual bool RecognisesContent(const SceneSource& source) const;

  // True if the reader can read the source `source`. By default, a reader recognises files whose name has one
  // of the endings Endings().
  virtual bool Recognises(const SceneSource& source) const;

  // Reads the scene called `name`, and builds its patches. Throws InputError with the message "NAME:LINE:
  // error: what is wrong and how to mend it".
  virtual Scene Read(const std::string& name, const SceneOptions& options) const = 0;
};

// The registry of scene readers; SceneReaders() holds all readers.
using SceneReaderRegistry = Registry<const SceneReader>;

}  // namespace penumbra
