// display/atlas/light_atlas.h
//
// The light of a mesh as one picture, for programs that show textures.

#pragma once

#include "display/atlas/chart_layout.h"
#include "display/image.h"
#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

struct LightAtlas {
  ChartLayout layout;
  // Irradiance [W/m^2] at the centre of every pixel of a chart, at least 0: the interpolant's value there,
  // or, outside the patch, at the nearest point of the patch. 0 between charts.
  RgbImage irradiance;
  std::vector<PatchId> patch;  // of each pixel; kNoPatch between charts
};

// Throws InputError if the charts have no room (LayOutCharts).
LightAtlas MakeLightAtlas(const Scene& scene, const IrradianceMesh& mesh, int size);

// The irradiance as colours for a screen: exposure [m^2/W] * irradiance [W/m^2], encoded as sRGB.
Srgb8Image IrradianceOnScreen(const LightAtlas& atlas, double exposure);
// The radiosity as colours for a screen: exposure [m^2/W] * reflectance * irradiance [W/m^2], encoded as
// sRGB. Emitters are white.
Srgb8Image RadiosityOnScreen(const Scene& scene, const LightAtlas& atlas, double exposure);

}  // namespace penumbra
