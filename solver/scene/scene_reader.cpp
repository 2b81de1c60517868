#include "solver/scene/scene_reader.h"

#include <algorithm>

#include "solver/base/file_endings.h"

namespace penumbra {

bool SceneReader::RecognisesContent(const SceneSource&) const { return false; }

bool SceneReader::Recognises(const SceneSource& source) const {
  const std::vector<std::string> endings = Endings();
  return source.is_file && std::find(endings.begin(), endings.end(), EndingOf(source.name)) != endings.end();
}

}  // namespace penumbra
