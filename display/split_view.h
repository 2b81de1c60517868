// display/split_view.h
//
// The scratch images next to the picture that is computed from them (thesis B.3.2).

#pragma once

#include "display/camera.h"
#include "display/image.h"
#include "display/two_pass_display.h"
#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

// Fills `whole` with four quarters: triangle ids, one colour each; barycentric coordinates, with s red, t
// green and 1 - s - t blue; depths, with the nearest white; and `picture`. REQUIRES: frame and picture have
// the size of a quarter of `whole`; the frame shows `mesh` and was drawn with `rays`.
void PaintSplit(const RenderedFrame& frame, const PixelRays& rays, const IrradianceMesh& mesh,
                const Srgb8Image& picture, Srgb8Image* whole);

// The side of a quarter, for a side of the whole picture [pixels].
inline constexpr int QuarterSide(int side) { return side < 2 ? 1 : side / 2; }

}  // namespace penumbra
