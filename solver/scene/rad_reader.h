// solver/scene/rad_reader.h
//
// Scene descriptions of Radiance: polygons, spheres, cones, cylinders and rings with diffuse materials and
// lights. The commands `!xform` and `!genbox` are obeyed here, without a shell; other commands are refused.
// The numbers of lights are radiance, which times pi is emittance. Materials reflect on both sides, as in
// Radiance, so that each of their surfaces gets a second, reversed face; lights shine from their fronts.
// Curved surfaces are cut into polygons (kCurveTolerance). What is not diffuse is left out, named in
// warnings.

#pragma once

#include <filesystem>

#include "solver/scene/scene_options.h"
#include "solver/scene/scene_reader.h"

namespace penumbra {

// The scene in the file and in the files that its commands name. Throws InputError with one line, "FILE:LINE:
// error: what is wrong and how to mend it".
Scene ReadRad(const std::filesystem::path& path, const SceneOptions& options);

// The reader of files whose names end in .rad.
SceneReaderRegistry::Method RadReaderMethod();

}  // namespace penumbra
