// solver/scene/assimp_reader.h
//
// The reader of files of 3D modelling programs (glTF, COLLADA, FBX and the others of ForeignFormats()), which
// uses the library Assimp.

#pragma once

#include "solver/scene/scene_reader.h"

namespace penumbra {

// Each instance of a node of the file's scene graph becomes an object. The base colour or diffuse colour of a
// material becomes its reflectance. The emission colour, multiplied by the emission strength, becomes the
// emittance in W/m^2, like Ke in MTL files. Faces without a material get the reflectance 0.5. The list
// Scene::warnings begins with a note that says what was read, with which unit and up axis, and what was left
// out.
SceneReaderRegistry::Method AssimpReaderMethod();

}  // namespace penumbra
