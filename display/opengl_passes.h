// display/opengl_passes.h
//
// The two passes as the thesis draws them (3.4.1, 3.4.2): by the graphics system, triangle ids as colours,
// barycentric coordinates as colours, both images read back. The coordinates are computed in each pixel from
// the planes through the eye and the edges, not interpolated from the corners: corners are rounded to parts
// of a pixel, and what reaches behind the eye is cut off in single precision. Off screen, without a window
// system. No dither, no multisampling, no sRGB.
//
// Edges follow the graphics system's rules: T-vertices between patches are not closed.

#pragma once

#include <memory>

#include "display/passes.h"
#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

enum class OpenGlCoordinates {
  kFloat,    // within 1e-4 of the rasteriser's
  kTexture,  // looked up in a texture of 256 x 256 texels of 8 bits, as in the thesis: multiples of 1/255
};

// REQUIRES: fewer than kNoTriangle triangles. Throws InputError if the system gives no context of OpenGL 3.3
// that needs no window, or one that lacks what is used (GL_ARB_clip_control). A picture that is larger than
// it can draw throws InputError, too. While a pass is drawn its context is current in the calling thread;
// none is afterwards.
std::unique_ptr<Passes> OpenGlPasses(const IrradianceMesh& mesh,
                                     OpenGlCoordinates coordinates = OpenGlCoordinates::kFloat);

}  // namespace penumbra
