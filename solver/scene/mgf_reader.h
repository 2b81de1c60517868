// solver/scene/mgf_reader.h
//
// Reads the Materials and Geometry Format, MGF (Ward 1996), which the program RenderPark also reads, with all
// surfaces, transformations and arrays. The number of an `ed` statement is the emittance in W/m^2, like Ke in
// MTL files. For each face of a surface with `sides 2`, the default of MGF, a reversed face is added. Curved
// surfaces are cut into polygons (kCurveTolerance). Specular and transmitting parts of materials are left out
// with a warning.

#pragma once

#include <filesystem>

#include "solver/scene/scene_options.h"
#include "solver/scene/scene_reader.h"

namespace penumbra {

// Reads the scene from the file and from the files that the file includes. Throws InputError with one line,
// "FILE:LINE: error: what is wrong and how to mend it".
Scene ReadMgf(const std::filesystem::path& path, const SceneOptions& options);

// The reader of files whose names end in .mgf.
SceneReaderRegistry::Method MgfReaderMethod();

}  // namespace penumbra
