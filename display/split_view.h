// display/split_view.h
//
// Shows the intermediate images of the two-pass display (triangle ids, barycentric coordinates, depths) next
// to the final picture (thesis B.3.2).

#pragma once

#include "display/camera.h"
#include "display/image.h"
#include "display/two_pass_display.h"
#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

// Fills the four quarters of `whole` with: the triangle ids, in a different colour for each triangle; the
// barycentric coordinates as colours (s red, t green, 1 - s - t blue); the depths, with the nearest point
// white; and `picture`. REQUIRES: frame and picture have the size of a quarter of `whole`; the frame shows
// `mesh` and was drawn with `rays`.
void PaintSplit(const RenderedFrame& frame, const PixelRays& rays, const IrradianceMesh& mesh,
                const Srgb8Image& picture, Srgb8Image* whole);

// The width (or height) of a quarter, given the width (or height) of the whole picture [pixels].
inline constexpr int QuarterSide(int side) { return side < 2 ? 1 : side / 2; }

}  // namespace penumbra
