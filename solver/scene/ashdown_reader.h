// solver/scene/ashdown_reader.h
//
// Worlds of I. Ashdown, Radiosity: A Programmer's Perspective, 1994, section 3.12. A world file (.wld) places
// entity files (.ent, ashdown_entity.h) by scaling, rotation and translation.

#pragma once

#include <string>

#include "solver/scene/scene_options.h"
#include "solver/scene/scene_reader.h"

namespace penumbra {

// The scene of the world file `path`. The faces are the patches of all instances, in the order of the files;
// elements are checked and counted, but the solver makes elements of its own. Each instance is an object
// called after its entity file, with a number if the name occurs again. A vertex is scaled, then rotated
// about the axes x, y and z, counter-clockwise seen from the tip of the axis [degrees], and then moved
// (section 3.11). Exitances are taken as emittances [W/m^2]. Entity files are searched for in the folder of
// the world, first by the exact name, then without regard to upper and lower case. Throws InputError with the
// message "FILE:LINE: error: what is wrong and how to mend it".
Scene ReadAshdownWorld(const std::string& path, const SceneOptions& options);

// The scene of one instance of the entity file `path` in its own frame. Throws the same exceptions as
// ReadAshdownWorld().
Scene ReadAshdownEntityScene(const std::string& path, const SceneOptions& options);

// The reader of files whose names end in .wld or .ent.
SceneReaderRegistry::Method AshdownReaderMethod();

}  // namespace penumbra
