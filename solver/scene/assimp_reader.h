// solver/scene/assimp_reader.h
//
// The reader of the files of modellers: glTF, COLLADA, FBX and others (ForeignFormats()), through Assimp.

#pragma once

#include "solver/scene/scene_reader.h"

namespace penumbra {

// Nodes and their instances become objects. Base colour or diffuse colour is reflectance. The emission
// colour, multiplied by its strength, is emittance in W/m^2, as Ke is in OBJ files. Faces without a material
// are 50 % grey. Scene::warnings begins with a note of what was read and in which frame, and of what was left
// out.
SceneReaderRegistry::Method AssimpReaderMethod();

}  // namespace penumbra
