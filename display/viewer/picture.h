// display/viewer/picture.h
//
// Makes the picture of a Snapshot (state of the solver): the content of the window without panels. The
// picture depends only on the Snapshot, the view and the drawing of the overlays; the members of PictureMaker
// are caches that save time.

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "display/two_pass_display.h"
#include "display/viewer/overlay.h"
#include "display/viewer/overlay_painter.h"
#include "display/viewer/ray_picture.h"

namespace penumbra::viewer {

// The quantity that false colours represent in a picture.
enum class ColourScale { kNone, kIrradiance /* [W/m^2] */, kError /* relative */ };
const char* UnitOf(ColourScale scale);

class PictureMaker {
 public:
  // Draws a picture of width x height pixels. REQUIRES: width, height > 0; ValidateCamera() accepts the
  // view's camera.
  const Srgb8Image& Make(const OverlayContext& context, const ViewState& view, const OverlayDrawing& drawing,
                         int width, int height);

  // True if rays are still being cast for the picture, or if the picture does not yet contain all rays that
  // have been cast.
  bool Busy() const { return rays_.Busy(); }
  // True if the last picture was made by ray casting, at least for the pixels whose rays were complete.
  bool by_rays() const { return by_rays_; }
  double RayFraction() const { return rays_.Fraction(); }
  void CancelRays() { rays_.Cancel(); }

  // The following functions return properties of the last picture.
  const Srgb8Image& screen() const { return screen_; }
  const RenderedFrame* frame() const { return display_ ? &display_->frame() : nullptr; }
  // The values from which the screen colours were computed: radiosity [W/m^2] or reflectance [1].
  const RgbImage& linear() const { return by_rays_ ? ray_linear_ : display_->frame().linear; }
  const DepthMap* depth() const { return depth_ ? &*depth_ : nullptr; }
  // The mesh that frame() shows.
  const IrradianceMesh& drawn() const { return drawn_->mesh(); }
  // The kind of the drawn mesh. The kind of the drawn mesh differs from MeshOf(view.mode) until the mesh of
  // kind MeshOf(view.mode) has been built.
  MeshKind drawn_kind() const { return kind_; }
  // The exposure of the last picture: linear screen value per W/m^2 of radiosity.
  double exposure() const { return exposure_; }
  ColourScale scale() const { return scale_; }
  double scale_top() const { return scale_top_; }  // value at the upper end of the false-colour scale
  // The reason why the chosen back end (OpenGL) could not draw the picture, so that the software rasteriser
  // has drawn the picture instead. The text backend_error() is empty if the chosen back end has drawn the
  // picture.
  const std::string& backend_error() const { return backend_error_; }
  const FrameTimes& times() const { return times_; }

 private:
  void ChooseMesh(const OverlayContext& context, const ViewState& view);
  std::unique_ptr<Passes> MakePasses();
  void CastRays(const OverlayContext& context, const ViewState& view, int width, int height);
  void Shade(const OverlayContext& context, const ViewState& view, Srgb8Image* out);
  bool Shows(const ErrorMap* errors) const;
  void PaintErrors(const ErrorMap& errors, double top, Srgb8Image* out) const;

  std::shared_ptr<const MeshState> whole_;  // the mesh for the drawing mode
  // the drawn mesh: whole_, or its selected part if the picture shows only the selection
  std::shared_ptr<const MeshState> drawn_;
  // If only the selection is drawn, the indices of the drawn triangles in whole_.
  std::vector<std::uint32_t> left_;
  Selection isolated_;
  AnalysisResults isolated_by_;
  std::optional<TwoPassDisplay> display_;
  Backend backend_ = Backend::kSoftware;  // back end that the view requests
  OpenGlCoordinates coordinates_ = OpenGlCoordinates::kFloat;
  std::string backend_error_;
  std::optional<DepthMap> depth_;
  RayPicture rays_;
  bool by_rays_ = false;  // true if the last picture was made by ray casting
  RgbImage ray_linear_;
  std::vector<PixelKind> ray_kind_;
  Srgb8Image screen_, part_;
  MeshKind kind_ = MeshKind::kFlat;
  double exposure_ = 1, scale_top_ = 1;
  ColourScale scale_ = ColourScale::kNone;
  FrameTimes times_;
};

// The exposure that MeterExposure() finds from a subset of the pixels: every kMeterStride-th pixel of every
// kMeterStride-th row.
double MeterSparsely(const RgbImage& linear, const std::vector<PixelKind>& kinds);
inline constexpr int kMeterStride = 4;

}  // namespace penumbra::viewer
