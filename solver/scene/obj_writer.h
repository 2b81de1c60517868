// solver/scene/obj_writer.h
//
// Scenes as Wavefront OBJ with MTL, for our reader to give the same scene again: the same faces in the same
// order, every number to the bit.

#pragma once

#include <string>
#include <string_view>

#include "solver/scene/scene.h"
#include "solver/scene/scene_writer.h"

namespace penumbra {

// The text of the OBJ file; `mtl_name` is the name of its library, in the same folder. Faces that were
// dropped stay as faces without area, so that the others keep their numbers. Names that could not be read
// back are changed; cameras are left out.
std::string ObjText(const Scene& scene, std::string_view mtl_name);
// The text of the library: Kd is reflectance, Ke emittance [W/m^2].
std::string MtlText(const Scene& scene);

SceneWriterRegistry::Method ObjWriterMethod();

}  // namespace penumbra
