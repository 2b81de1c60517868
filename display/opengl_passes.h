// display/opengl_passes.h
//
// The two passes of the display, drawn by OpenGL as in the thesis (3.4.1, 3.4.2): triangle ids and
// barycentric coordinates are drawn as colours, and both images are read back. The barycentric coordinates of
// a pixel are computed from the planes through the eye and the edges of the triangle. Interpolation of
// barycentric coordinates between the triangle's corners would be less accurate: the hardware rounds corners
// to fractions of a pixel, and clips triangles that extend behind the eye in single precision. Both passes
// are drawn off screen, without a window system. While the passes are drawn, dithering, multisampling and
// sRGB conversion are off.
//
// OpenGL determines which pixels a triangle covers. Gaps at T-vertices between patches are therefore not
// closed, unlike in the software rasteriser.

#pragma once

#include <memory>

#include "display/passes.h"
#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

enum class OpenGlCoordinates {
  kFloat,    // coordinates as floats, which agree with the software rasteriser to 1e-4
  kTexture,  // coordinates from a texture of 256 x 256 texels of 8 bits, as in the thesis: multiples of 1/255
};

// Makes OpenGL passes that draw the triangles of the mesh. Throws InputError if the system has no OpenGL 3.3
// context without a window, or if the context lacks GL_ARB_clip_control. The passes throw InputError for
// pictures larger than OpenGL can draw. While a pass is drawn, its OpenGL context is current in the calling
// thread; afterwards, no OpenGL context is current. REQUIRES: the mesh has fewer than kNoTriangle triangles.
std::unique_ptr<Passes> OpenGlPasses(const IrradianceMesh& mesh,
                                     OpenGlCoordinates coordinates = OpenGlCoordinates::kFloat);

}  // namespace penumbra
