// display/walkthrough/page_data.h
//
// The data about a scene and its light in the HTML page that shows a mesh in a browser.

#pragma once

#include <string>

#include "display/mesh_writer.h"

namespace penumbra {

struct PageData {
  // A JSON text with names, materials, cameras, the exposure, and the numbers of vertices and triangles. The
  // JSON text contains no `<`, so that it can be embedded in HTML.
  std::string description;
  // Five little-endian arrays, one after the other. Array 1 of the page data has the position of each vertex
  // relative to the centre of the scene (3 floats) [m]. Array 2 of the page data has the three vertex indices
  // of each triangle (uint32). Array 3 of the page data has the scale of each triangle's irradiance samples
  // (float) [W/m^2]. Array 4 of the page data has six samples of red, green and blue for each triangle
  // (int16), in the order of MeshNodes; the irradiance of a sample is scale * int16. Array 5 of the page data
  // has a byte for each triangle; bit k tells whether the edge from vertex k to the next vertex is a
  // discontinuity.
  std::string arrays;
};

// The samples of a triangle are integer multiples of the triangle's scale. The error of a sample is at most
// kSampleError * (largest irradiance of the triangle) + kEqualIrradiance * (largest irradiance of the mesh).
inline constexpr int kLargestSample = 32767;
// The value of kSampleError is half a quantisation step, plus an allowance for the rounding error of the
// scale.
inline constexpr double kSampleError = 0.51 / kLargestSample;

// Makes the data of the HTML page. Throws InputError if a position or an irradiance exceeds the range of
// floats.
PageData MakePageData(const MeshExport& from);

}  // namespace penumbra
