// display/viewer/picture.h
//
// Makes the picture of a Snapshot (state of the solver): the content of the window without panels. The
// picture depends only on the Snapshot, the view and the drawing of the overlays; the members of PictureMaker
// are caches that save time.

#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "display/false_colour.h"
#include "display/two_pass_display.h"
#include "display/viewer/overlay.h"
#include "display/viewer/overlay_painter.h"
#include "display/viewer/ray_picture.h"

namespace penumbra::viewer {

// The quantity that false colours represent in a picture.
enum class ColourScale { kNone, kIrradiance /* [W/m^2] */, kLux, kError /* relative */ };
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
  // True if the last picture shows reflectances and emitters, since no light is known yet.
  bool previews() const { return previews_; }
  // The kind of the drawn mesh. The kind differs from MeshOf(view.mode) as long as the mesh of that kind does
  // not exist.
  MeshKind drawn_kind() const { return kind_; }
  // The exposure of the last picture: linear screen value per W/m^2 of radiosity.
  double exposure() const { return exposure_; }
  ColourScale scale() const { return scale_; }
  double scale_top() const { return scale_values_.top; }  // of false colours
  const FalseColourScale& scale_values() const { return scale_values_; }
  // If the chosen back end could not draw the picture, the reason; the software rasteriser has then drawn the
  // picture instead. Empty if the chosen back end has drawn the picture.
  const std::string& backend_error() const { return backend_error_; }
  const FrameTimes& times() const { return times_; }

 private:
  void ChooseMesh(const OverlayContext& context, const ViewState& view);
  void UpdatePreview(const OverlayContext& context);
  void ChoosePart(const OverlayContext& context);
  std::unique_ptr<Passes> MakePasses();
  void CastRays(const OverlayContext& context, const ViewState& view, int width, int height);
  void Shade(const OverlayContext& context, const ViewState& view, Srgb8Image* out);
  bool Shows(const ErrorMap* errors) const;
  void PaintErrors(const ErrorMap& errors, double top, Srgb8Image* out) const;

  // Before any light is gathered: the patches in an even light, so that they can be told apart.
  std::shared_ptr<const MeshState> preview_, preview_of_;
  bool previews_ = false;                   // true if the last picture shows the preview
  std::shared_ptr<const MeshState> whole_;  // the mesh that the drawing mode needs
  // The mesh that is drawn: whole_, or a part of it if the selection is isolated.
  std::shared_ptr<const MeshState> drawn_;
  // If a part of the mesh is drawn, the indices of its triangles in whole_.
  std::vector<std::uint32_t> left_;
  Selection isolated_;
  std::set<std::int32_t> hidden_;  // the indices of the objects that are not drawn
  AnalysisResults isolated_by_;
  std::optional<TwoPassDisplay> display_;
  Backend backend_ = Backend::kSoftware;  // the drawing back end that the view requests
  OpenGlCoordinates coordinates_ = OpenGlCoordinates::kFloat;
  std::string backend_error_;
  std::optional<DepthMap> depth_;
  RayPicture rays_;
  bool by_rays_ = false;  // true if the last picture was made by ray casting
  RgbImage ray_linear_;
  std::vector<PixelKind> ray_kind_;
  Srgb8Image screen_, part_;
  MeshKind kind_ = MeshKind::kFlat;
  double exposure_ = 1;
  FalseColourScale scale_values_;
  ColourScale scale_ = ColourScale::kNone;
  FrameTimes times_;
};

// The exposure that MeterExposure() finds from a subset of the pixels: every kMeterStride-th pixel of every
// kMeterStride-th row.
double MeterSparsely(const RgbImage& linear, const std::vector<PixelKind>& kinds);
inline constexpr int kMeterStride = 4;

}  // namespace penumbra::viewer
