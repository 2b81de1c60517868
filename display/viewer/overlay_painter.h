// display/viewer/overlay_painter.h
//
// Paints overlays into the picture of the two-pass display. Surfaces hide the parts of overlays that lie
// behind them. Overlays are painted in software, so that pictures have the same bytes with and without a
// window.

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
  // Makes the depth map of an empty scene.
  DepthMap(const PixelRays& rays, int width, int height);
  // Makes the depth map of `frame`, which shows `mesh` and was drawn with `rays`.
  DepthMap(const PixelRays& rays, const RenderedFrame& frame, const IrradianceMesh& mesh);

  int width() const { return width_; }
  int height() const { return height_; }
  const PixelRays& rays() const { return rays_; }

  // The visibility threshold of a pixel [1/m]: a point is visible at the pixel if 1 / (depth of the point) is
  // at least the threshold. The threshold is 1 / (depth of the surface), minus the change of 1 / depth over
  // one pixel, so that points on the surface count as visible. The threshold is 0 at pixels that show no
  // surface.
  float Threshold(int x, int y) const { return inverse_[Index(x, y)]; }

 private:
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  PixelRays rays_;
  int width_, height_;
  std::vector<float> inverse_;
};

// The projection of a point: x and y in the picture [pixels], and 1 / depth [1/m], which is 0 or negative
// behind the eye.
struct ScreenPoint {
  double x = 0, y = 0, inverse_depth = 0;
};
ScreenPoint Project(const PixelRays& rays, const Vec3& point);

void PaintOverlay(const OverlayDrawing& drawing, const DepthMap& depth, Srgb8Image* picture);

// Selects the visible overlay line nearest to the picture point (x, y): returns its OverlayLine::pick if the
// distance is at most kPickDistance, and an empty selection otherwise.
Selection PickLine(const OverlayDrawing& drawing, const DepthMap& depth, double x, double y);
// The largest distance of a click from an overlay line that the click selects [pixels].
inline constexpr double kPickDistance = 6;

}  // namespace penumbra::viewer
