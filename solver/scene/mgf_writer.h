// solver/scene/mgf_writer.h

#pragma once

#include <string>

#include "solver/scene/scene.h"
#include "solver/scene/scene_writer.h"

namespace penumbra {

// The scene in the Materials and Geometry Format (Ward 1996), which RenderPark reads: the patches as
// one-sided polygons, counter-clockwise seen from their fronts; diffuse reflectance, and diffuse emittance in
// W/m^2. MGF has no RGB colours. A colour is written as luminance and chromaticity, computed with the
// primaries of MGF's own conversion, so that readers that convert back get the same three numbers.
std::string MgfText(const Scene& scene);

SceneWriterRegistry::Method MgfWriterMethod();

}  // namespace penumbra
