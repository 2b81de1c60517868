// solver/scene/view3d_reader.h
//
// Scenes of View3D, a program for view factors between surfaces (Walton 2002, NISTIR 6925): vertices and
// surfaces of three or four corners, or surfaces by position, azimuth and tilt. There is no library for these
// files.

#pragma once

#include <string_view>

#include "solver/scene/scene_options.h"
#include "solver/scene/scene_reader.h"

namespace penumbra {

// The scene in the text of the file `path`. Each surface is an object with the surface's name, except that
// surfaces that View3D combines are one object with the name of the first. The reflectance of a surface is
// 1 - emittance. Nothing emits light. A subsurface precedes its base, which it covers. An obstruction has a
// black face on each side. Throws InputError with one line, "FILE:LINE: error: what is wrong and how to mend
// it", also for surfaces that mask a part of others.
Scene ReadView3d(std::string_view text, const std::string& path, const SceneOptions& options);

// The reader of files whose names end in .vs3.
SceneReaderRegistry::Method View3dReaderMethod();

}  // namespace penumbra
