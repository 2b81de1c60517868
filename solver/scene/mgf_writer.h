// solver/scene/mgf_writer.h

#pragma once

#include <string>

#include "solver/scene/scene.h"
#include "solver/scene/scene_writer.h"

namespace penumbra {

// The scene in the Materials and Geometry Format (Ward 1996) that RenderPark reads: the patches as one-sided
// polygons, counter-clockwise from their fronts; diffuse reflectance, and diffuse emittance in W/m^2. MGF
// knows no RGB: a colour becomes its luminance and chromaticity by the primaries of MGF's own conversion, so
// that readers that convert back get the same three numbers.
std::string MgfText(const Scene& scene);

// CIE XYZ of a colour by those primaries.
Vec3 MgfXyz(const Rgb& rgb);

SceneWriterRegistry::Method MgfWriterMethod();

}  // namespace penumbra
