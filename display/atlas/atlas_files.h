// display/atlas/atlas_files.h
//
// Writes irradiance maps: pictures of all patches, and scenes that wear such a picture.

#pragma once

#include <string>
#include <vector>

#include "display/mesh_writer.h"

namespace penumbra {

// The endings of the files that AtlasBytes() makes, without the dot.
std::vector<std::string> AtlasEndings();

// The bytes of a file whose map is `size` pixels a side, by the ending of its name:
//   exr  irradiance [W/m^2], linear
//   png  exposure * irradiance, as a screen shows it
//   glb  glTF 2.0, y up: two triangles or one a patch, unlit, with the radiosity on a screen as the texture;
//   its
//        coordinates stand in TEXCOORD_0 and in TEXCOORD_1, where programs look for those of light maps
// An exposure that is not given is that of MeterMesh(). Throws InputError if the charts have no room
// (LayOutCharts) or a value exceeds floats. REQUIRES: the ending is one of AtlasEndings().
std::string AtlasBytes(const std::string& ending, const MeshExport& from, int size);

}  // namespace penumbra
