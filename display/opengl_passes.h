// display/opengl_passes.h
//
// The two passes drawn by the graphics system, as in the thesis (3.4.1, 3.4.2): triangle ids and barycentric
// coordinates are drawn as colours, and both images are read back. The barycentric coordinates of a pixel are
// computed from the planes through the eye and the edges of the triangle. Interpolation between the
// triangle's corners would be less accurate: the hardware rounds corners to fractions of a pixel, and clips
// triangles that extend behind the eye in single precision. The passes are drawn off screen, without a window
// system. Dithering, multisampling and sRGB conversion are off.
//
// The graphics system determines which pixels a triangle covers; gaps at T-vertices between patches are
// therefore not closed, unlike in the software rasteriser.

#pragma once

#include <memory>

#include "display/passes.h"
#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

enum class OpenGlCoordinates {
  kFloat,    // the rasteriser's coordinates to 1e-4
  kTexture,  // from a texture of 256 x 256 texels of 8 bits, as in the thesis: multiples of 1/255
};

// Makes passes that draw the triangles of the mesh. Throws InputError if the system has no OpenGL 3.3 context
// without a window, or one without GL_ARB_clip_control. The passes throw InputError for pictures larger than
// the system can draw. While a pass is drawn, its OpenGL context is current in the calling thread;
// afterwards, no context is current. REQUIRES: the mesh has fewer than kNoTriangle triangles.
std::unique_ptr<Passes> OpenGlPasses(const IrradianceMesh& mesh,
                                     OpenGlCoordinates coordinates = OpenGlCoordinates::kFloat);

}  // namespace penumbra
