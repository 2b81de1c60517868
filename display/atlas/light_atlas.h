// display/atlas/light_atlas.h
//
// The irradiance of a mesh as one picture (texture atlas), for programs that show textures.

#pragma once

#include "display/atlas/chart_layout.h"
#include "display/image.h"
#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

struct LightAtlas {
  ChartLayout layout;
  // The irradiance [W/m^2] at the centre of each pixel of a chart (rectangle around one patch), clamped to
  // values >= 0. Pixels of a chart outside its patch have the irradiance at the nearest point of the patch.
  // Pixels between charts have irradiance 0.
  RgbImage irradiance;
  std::vector<PatchId> patch;  // the patch of each pixel; kNoPatch between charts
};

// Makes a light atlas of size x size pixels. Throws InputError if the picture has no room for the charts of
// all patches (LayOutCharts).
LightAtlas MakeLightAtlas(const Scene& scene, const IrradianceMesh& mesh, int size);

// The irradiance of the atlas as colours for a screen: exposure [m^2/W] * irradiance [W/m^2], encoded as
// sRGB.
Srgb8Image IrradianceOnScreen(const LightAtlas& atlas, double exposure);
// The radiosity of the atlas as colours for a screen: exposure [m^2/W] * reflectance * irradiance [W/m^2],
// encoded as sRGB. In the picture of radiosity, emitters are white.
Srgb8Image RadiosityOnScreen(const Scene& scene, const LightAtlas& atlas, double exposure);

}  // namespace penumbra
