// solver/scene/obj_writer.h
//
// Writes scenes as Wavefront OBJ with MTL. ReadObj() gives the same scene again: the same faces in the same
// order, every number to the bit.

#pragma once

#include <string>
#include <string_view>

#include "solver/scene/scene.h"
#include "solver/scene/scene_writer.h"

namespace penumbra {

// The text of the OBJ file; `mtl_name` is the name of the material library, a file in the same folder.
// Dropped faces become faces without area, so that the other faces keep their numbers. Names that ReadObj()
// could not read back are changed. Cameras are omitted.
std::string ObjText(const Scene& scene, std::string_view mtl_name);
// The text of the material library: Kd is reflectance, Ke is emittance [W/m^2].
std::string MtlText(const Scene& scene);

SceneWriterRegistry::Method ObjWriterMethod();

}  // namespace penumbra
