// solver/scene/mgf_reader.h
//
// The Materials and Geometry Format (Ward 1996), which RenderPark reads: all its surfaces, transformations
// and arrays. The number of `ed` is emittance in W/m^2, as Ke is in OBJ files. Surfaces with `sides 2`, MGF's
// default, get a second, reversed face each. Curved surfaces are cut into polygons (kCurveTolerance).
// Specular and transmitting parts of materials are left out with a warning.

#pragma once

#include <filesystem>

#include "solver/scene/scene_options.h"
#include "solver/scene/scene_reader.h"

namespace penumbra {

// The scene in the file and in the files that it includes. Throws InputError with one line, "FILE:LINE:
// error: what is wrong and how to mend it".
Scene ReadMgf(const std::filesystem::path& path, const SceneOptions& options);

// The reader of files whose names end in .mgf.
SceneReaderRegistry::Method MgfReaderMethod();

}  // namespace penumbra
