// display/atlas/atlas_files.h
//
// Writes irradiance maps: pictures with the irradiance of all patches, and scene files that use such a
// picture as a texture.

#pragma once

#include <string>
#include <vector>

#include "display/atlas/light_atlas.h"
#include "display/mesh_writer.h"

namespace penumbra {

// The file endings, without the dot, of the formats that AtlasBytes() can write.
std::vector<std::string> AtlasEndings();

// The bytes of an irradiance map of size x size pixels, in the format that belongs to the ending of the file.
// An `exr` file stores the linear irradiance [W/m^2]. A `png` file stores exposure * irradiance as colours
// for a screen. A `glb` file is a glTF 2.0 scene, y up, with one or two unlit triangles per patch; its
// texture is the radiosity as colours for a screen. A `glb` file stores texture coordinates in TEXCOORD_0 and
// again in TEXCOORD_1, where programs look for the coordinates of light maps. If MeshExport::exposure is not
// set, MeterMesh() determines the exposure. `places` are the texture coordinates of the map: charts of this
// program, or those of the scene. Throws InputError if MakeLightAtlas() does, or if a value exceeds the range
// of floats. REQUIRES: the ending is one of AtlasEndings().
std::string AtlasBytes(const std::string& ending, const MeshExport& from, int size,
                       AtlasPlaces places = AtlasPlaces::kOwn);

}  // namespace penumbra
