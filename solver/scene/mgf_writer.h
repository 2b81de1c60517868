// solver/scene/mgf_writer.h

#pragma once

#include <string>

#include "solver/scene/scene.h"
#include "solver/scene/scene_writer.h"

namespace penumbra {

// The scene as text in the Materials and Geometry Format, MGF (Ward 1996), which the program RenderPark
// reads. The text contains the patches as one-sided polygons, counter-clockwise seen from the front, with
// diffuse reflectance and diffuse emittance in W/m^2. MGF has no RGB colours. An RGB colour is written as
// luminance and chromaticity, computed with the primaries of MGF's own conversion, so that readers that
// convert back to RGB get the same three numbers.
std::string MgfText(const Scene& scene);

SceneWriterRegistry::Method MgfWriterMethod();

}  // namespace penumbra
