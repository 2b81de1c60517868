#include "solver/scene/scene_readers.h"

#include <algorithm>

#include "solver/base/file_endings.h"
#include "solver/scene/ashdown_reader.h"
#include "solver/scene/assimp_reader.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/mgf_reader.h"
#include "solver/scene/obj_reader.h"
#include "solver/scene/ply_reader.h"
#include "solver/scene/rad_reader.h"
#include "solver/scene/view3d_reader.h"

namespace penumbra {

SceneReaderRegistry& SceneReaders() {
  static SceneReaderRegistry registry(
      "scene reader",
      {ObjReaderMethod(), AssimpReaderMethod(), PlyReaderMethod(), MgfReaderMethod(), RadReaderMethod(),
       View3dReaderMethod(), AshdownReaderMethod(), BuiltinSceneReaderMethod()});
  return registry;
}

bool HasSceneEnding(const std::string& path) {
  const std::string ending = EndingOf(path);
  for (const SceneReaderRegistry::Method& method : SceneReaders().methods()) {
    const std::vector<std::string> endings = method.make()->Endings();
    if (std::find(endings.begin(), endings.end(), ending) != endings.end()) return true;
  }
  return false;
}

}  // namespace penumbra
