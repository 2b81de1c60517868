// display/split_view.h
//
// The scratch images beside the picture that is made from them (thesis B.3.2).

#pragma once

#include "display/camera.h"
#include "display/image.h"
#include "display/two_pass_display.h"
#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

// Fills `whole` with four quarters: triangle ids, each in a colour of its own; barycentric
// coordinates, s red, t green, 1 - s - t blue; depths, the nearest white; and `picture`. The frame and the
// picture are of the size of a quarter of `whole`; the frame was drawn of the mesh with these rays.
void PaintSplit(const RenderedFrame& frame, const PixelRays& rays, const IrradianceMesh& mesh,
                const Srgb8Image& picture, Srgb8Image* whole);

// A side of a quarter.
inline constexpr int QuarterSide(int side) { return side < 2 ? 1 : side / 2; }

}  // namespace penumbra
