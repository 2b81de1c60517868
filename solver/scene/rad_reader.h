// solver/scene/rad_reader.h
//
// Reads scene descriptions of the renderer Radiance: polygons, spheres, cones, cylinders and rings with
// diffuse materials and lights. The reader itself executes the commands `!xform` and `!genbox`, without a
// shell; other commands in the file are an error. The numbers that define a light in Radiance are its
// radiance, which is multiplied by pi to give the emittance. Materials reflect on both sides, as in Radiance,
// so that a reversed face is added for each face; lights emit from their fronts only. Curved surfaces are cut
// into polygons (kCurveTolerance). Materials, or parts of materials, that are not diffuse are left out, and
// warnings name them.

#pragma once

#include <filesystem>

#include "solver/scene/scene_options.h"
#include "solver/scene/scene_reader.h"

namespace penumbra {

// Reads the scene from the file and from the files that the commands in the file name. Throws InputError with
// one line, "FILE:LINE: error: what is wrong and how to mend it".
Scene ReadRad(const std::filesystem::path& path, const SceneOptions& options);

// The reader of files whose names end in .rad.
SceneReaderRegistry::Method RadReaderMethod();

}  // namespace penumbra
