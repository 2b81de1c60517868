// display/split_view.h
//
// Shows the scratch images next to the picture that is made from them (thesis B.3.2).

#pragma once

#include "display/camera.h"
#include "display/image.h"
#include "display/two_pass_display.h"
#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

// Paints a picture of width x height pixels in four quarters: triangle ids, each id in its own colour;
// barycentric coordinates, s red, t green, 1 - s - t blue; depths, the nearest white; and `picture`.
// REQUIRES: the frame and the picture have the size of a quarter, and the frame was drawn from the mesh with
// `rays`.
void PaintSplit(const RenderedFrame& frame, const PixelRays& rays, const IrradianceMesh& mesh,
                const Srgb8Image& picture, int width, int height, Srgb8Image* out);

// The side of a quarter, for a side of the whole picture [pixels].
inline constexpr int QuarterSide(int side) { return side < 2 ? 1 : side / 2; }

}  // namespace penumbra
