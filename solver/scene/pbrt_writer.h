// solver/scene/pbrt_writer.h

#pragma once

#include <string>

#include "solver/scene/scene.h"
#include "solver/scene/scene_writer.h"

namespace penumbra {

// Returns the scene as a text for the renderer pbrt, version 4. The patches are written as triangles; the
// fronts of emitters become diffuse area lights with the radiance emittance / pi. The text selects a path
// tracer, the camera, and an EXR image of width x height pixels (height <= width). Because of a limitation of
// pbrt, the backs of patches reflect like fronts.
std::string PbrtText(const Scene& scene, const Camera& camera, int width, int height);

SceneWriterRegistry::Method PbrtWriterMethod();

}  // namespace penumbra
