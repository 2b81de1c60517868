#include "solver/scene/scene_writers.h"

#include "solver/scene/mgf_writer.h"
#include "solver/scene/obj_writer.h"
#include "solver/scene/pbrt_writer.h"

namespace penumbra {

SceneWriterRegistry& SceneWriters() {
  static SceneWriterRegistry registry("scene writer",
                                      {ObjWriterMethod(), PbrtWriterMethod(), MgfWriterMethod()});
  return registry;
}

}  // namespace penumbra
