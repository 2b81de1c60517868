// display/atlas/light_atlas.h
//
// The irradiance of a mesh as one picture (texture atlas), for programs that show textures.

#pragma once

#include <cstdint>
#include <vector>

#include "display/atlas/chart_layout.h"
#include "display/atlas/texture_charts.h"
#include "display/image.h"
#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

// The texture coordinates of an atlas.
enum class AtlasPlaces : std::uint8_t {
  kOwn,    // one chart for each patch, placed by LayOutCharts()
  kScene,  // the texture coordinates of the scene's faces
};

struct LightAtlas {
  ChartLayout layout;                  // charts of the patches; empty with AtlasPlaces::kScene
  std::vector<AtlasPolygon> polygons;  // the polygons of the scene, with their places on the picture
  // The irradiance [W/m^2] at the centre of each pixel of a chart (rectangle around one patch) or face,
  // clamped to values >= 0. Pixels outside the patch or face, but in its padding, have the irradiance at its
  // nearest point. All other pixels have irradiance 0.
  RgbImage irradiance;
  std::vector<PatchId> patch;  // the patch whose light each pixel has; kNoPatch for all other pixels
};

// Makes a light atlas of size x size pixels. With AtlasPlaces::kOwn, throws InputError if the picture has no
// room for the charts of all patches (LayOutCharts). With AtlasPlaces::kScene, throws InputError if a face
// has no texture coordinates on the picture (PolygonsOfFaces), or if two faces cover the same pixels.
LightAtlas MakeLightAtlas(const Scene& scene, const IrradianceMesh& mesh, int size,
                          AtlasPlaces places = AtlasPlaces::kOwn);

// The irradiance of the atlas as colours for a screen: exposure [m^2/W] * irradiance [W/m^2], encoded as
// sRGB.
Srgb8Image IrradianceOnScreen(const LightAtlas& atlas, double exposure);
// The radiosity of the atlas as colours for a screen: exposure [m^2/W] * reflectance * irradiance [W/m^2],
// encoded as sRGB. In the picture of radiosity, emitters are white.
Srgb8Image RadiosityOnScreen(const Scene& scene, const LightAtlas& atlas, double exposure);

}  // namespace penumbra
