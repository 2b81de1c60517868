// display/viewer/overlay_painter.h
//
// Paints overlays into the display's picture, hidden by what stands in front of them. All in software, as the
// display itself: the same bytes with and without a window.

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

// How deep each pixel of a picture is.
class DepthMap {
 public:
  // Nothing stands anywhere.
  DepthMap(const PixelRays& rays, int width, int height);
  // The triangles of a frame that was drawn of the mesh with these rays.
  DepthMap(const PixelRays& rays, const RenderedFrame& frame, const IrradianceMesh& mesh);

  int width() const { return width_; }
  int height() const { return height_; }
  const PixelRays& rays() const { return rays_; }

  // 1 / depth [1/m], less what the surface gains within a pixel on either side: what lies on the surface is
  // before it. 0 where nothing stands.
  float Threshold(int x, int y) const { return inverse_[Index(x, y)]; }

 private:
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  PixelRays rays_;
  int width_, height_;
  std::vector<float> inverse_;
};

// Where a point is in a picture: pixels, and 1 / depth [1/m], which is not above 0 behind the eye.
struct ScreenPoint {
  double x = 0, y = 0, inverse_depth = 0;
};
ScreenPoint Project(const PixelRays& rays, const Vec3& point);

void PaintOverlay(const OverlayDrawing& drawing, const DepthMap& depth, Srgb8Image* picture);

// The selection of the visible line that passes nearest to (x, y), at most kPickDistance off; an empty one if
// there is none.
Selection PickLine(const OverlayDrawing& drawing, const DepthMap& depth, double x, double y);
inline constexpr double kPickDistance = 6;  // [pixels]

}  // namespace penumbra::viewer
