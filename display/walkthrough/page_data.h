// display/walkthrough/page_data.h
//
// What the page for browsers knows of a scene and its light.

#pragma once

#include <string>

#include "display/mesh_writer.h"

namespace penumbra {

struct PageData {
  // JSON: names, materials, cameras, exposure, and how many vertices and triangles there are. Contains no
  // `<`, so that it may stand in HTML.
  std::string description;
  // Little-endian, one array after the other: positions of the vertices, from the centre of the scene (3
  // floats each) [m]; three vertices a triangle (uint32); a scale a triangle (float) [W/m^2]; six samples a
  // triangle of red, green and blue (int16), in the order of MeshNodes; a byte a triangle whose bit k says
  // whether the edge from vertex k to the next is a discontinuity. The irradiance of a sample is scale *
  // int16.
  std::string arrays;
};

// The samples of a triangle are multiples of its scale: an irradiance is wrong by at most kSampleError of the
// triangle's largest one, over all channels, and by kEqualIrradiance of the mesh's (FindMeshNodes).
inline constexpr int kLargestSample = 32767;
inline constexpr double kSampleError = 0.51 / kLargestSample;  // half a step, and the rounding of the scale

// Throws InputError if a position or a value is larger than floats hold.
PageData MakePageData(const MeshExport& from);

}  // namespace penumbra
