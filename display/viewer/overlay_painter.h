// display/viewer/overlay_painter.h
//
// Paints overlays into the display's picture; surfaces in front hide them. The painter is software, like the
// display: pictures with and without a window have equal bytes.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "display/camera.h"
#include "display/image.h"
#include "display/two_pass_display.h"
#include "display/viewer/overlay_drawing.h"
#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra::viewer {

// The depth of each pixel of a picture.
class DepthMap {
 public:
  // A map of an empty scene.
  DepthMap(const PixelRays& rays, int width, int height);
  // The map of a frame of `mesh` that was drawn with these rays.
  DepthMap(const PixelRays& rays, const RenderedFrame& frame, const IrradianceMesh& mesh);

  int width() const { return width_; }
  int height() const { return height_; }
  const PixelRays& rays() const { return rays_; }

  // 1 / depth [1/m], minus the surface's change of 1 / depth within a pixel on either side, so that points on
  // the surface count as in front of it. 0 where there is no surface.
  float Threshold(int x, int y) const { return inverse_[Index(x, y)]; }

 private:
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  PixelRays rays_;
  int width_, height_;
  std::vector<float> inverse_;
};

// The position of a point in a picture: pixels, and 1 / depth [1/m], which is 0 or negative behind the eye.
struct ScreenPoint {
  double x = 0, y = 0, inverse_depth = 0;
};
ScreenPoint Project(const PixelRays& rays, const Vec3& point);

void PaintOverlay(const OverlayDrawing& drawing, const DepthMap& depth, Srgb8Image* picture);

// The selection of the visible line closest to (x, y), at most kPickDistance away; an empty selection if
// there is none.
Selection PickLine(const OverlayDrawing& drawing, const DepthMap& depth, double x, double y);
inline constexpr double kPickDistance = 6;  // [pixels]

}  // namespace penumbra::viewer
