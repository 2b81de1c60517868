// solver/scene/pbrt_writer.h

#pragma once

#include <string>

#include "solver/scene/scene.h"
#include "solver/scene/scene_writer.h"

namespace penumbra {

// The scene for pbrt, version 4: the patches as triangles; one-sided diffuse area lights of radiance
// emittance / pi on the fronts of emitters; the camera, with a path tracer and an EXR film of width x height
// pixels (height <= width). A limitation of pbrt: visible backs of patches reflect like fronts.
std::string PbrtText(const Scene& scene, const Camera& camera, int width, int height);

SceneWriterRegistry::Method PbrtWriterMethod();

}  // namespace penumbra
