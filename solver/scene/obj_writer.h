// solver/scene/obj_writer.h
//
// Writes scenes as Wavefront OBJ with MTL. Reading the written file by ReadObj() gives the same faces in the
// same order, with every number equal to the bit.

#pragma once

#include <string>
#include <string_view>

#include "solver/scene/scene.h"
#include "solver/scene/scene_writer.h"

namespace penumbra {

// Returns the text of the OBJ file of the scene; `mtl_name` is the name of the material library, a file in
// the same folder. Faces that were dropped while reading the scene are written as faces without area, so that
// the other faces keep their numbers. Names that ReadObj() could not read back are changed. Cameras are not
// written.
std::string ObjText(const Scene& scene, std::string_view mtl_name);
// Returns the text of the MTL material library: Kd is reflectance, Ke is emittance [W/m^2].
std::string MtlText(const Scene& scene);

SceneWriterRegistry::Method ObjWriterMethod();

}  // namespace penumbra
