// display/viewer/picture.h
//
// The picture of a snapshot: what the window shows, without its panels. A function of the snapshot, the view
// and what overlays add; everything kept here only saves time.

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

// What a picture's colours stand for, where they are false.
enum class ColourScale { kNone, kIrradiance /* [W/m^2] */, kError /* relative */ };
const char* UnitOf(ColourScale scale);

class PictureMaker {
 public:
  // Draws width x height pixels. REQUIRES: width, height > 0; the view's camera can see.
  const Srgb8Image& Make(const OverlayContext& context, const ViewState& view, const OverlayDrawing& drawing,
                         int width, int height);

  // Rays that are still under way, or are not shown yet.
  bool Busy() const { return rays_.Busy(); }
  // The last picture is by rays, as far as they are there.
  bool by_rays() const { return by_rays_; }
  double RayFraction() const { return rays_.Fraction(); }
  void CancelRays() { rays_.Cancel(); }

  // Of the last picture:
  const Srgb8Image& screen() const { return screen_; }
  const RenderedFrame* frame() const { return display_ ? &display_->frame() : nullptr; }
  // What the screen was made of: radiosity [W/m^2] or reflectance.
  const RgbImage& linear() const { return by_rays_ ? ray_linear_ : display_->frame().linear; }
  const DepthMap* depth() const { return depth_ ? &*depth_ : nullptr; }
  // The mesh that frame() was drawn of.
  const IrradianceMesh& drawn() const { return drawn_->mesh(); }
  // The kind of mesh that the mode got: another one where its own is not built yet.
  MeshKind drawn_kind() const { return kind_; }
  double exposure() const { return exposure_; }  // screen value per W/m^2
  ColourScale scale() const { return scale_; }
  double scale_top() const { return scale_top_; }  // of false colours
  // Why the view's back end did not draw the passes, and the rasteriser did; empty: it did.
  const std::string& backend_error() const { return backend_error_; }
  const FrameTimes& times() const { return times_; }

 private:
  void ChooseMesh(const OverlayContext& context, const ViewState& view);
  std::unique_ptr<Passes> MakePasses();
  void CastRays(const OverlayContext& context, const ViewState& view, int width, int height);
  void Shade(const OverlayContext& context, const ViewState& view, Srgb8Image* out);
  bool Shows(const ErrorMap* errors) const;
  void PaintErrors(const ErrorMap& errors, double top, Srgb8Image* out) const;

  std::shared_ptr<const MeshState> whole_;  // the mesh of the mode
  std::shared_ptr<const MeshState> drawn_;  // that, or what is left of it when a selection is isolated
  std::vector<std::uint32_t> left_;         // then, which of its triangles those are
  Selection isolated_;
  AnalysisResults isolated_by_;
  std::optional<TwoPassDisplay> display_;
  Backend backend_ = Backend::kSoftware;  // that was asked for
  OpenGlCoordinates coordinates_ = OpenGlCoordinates::kFloat;
  std::string backend_error_;
  std::optional<DepthMap> depth_;
  RayPicture rays_;
  bool by_rays_ = false;  // the last picture
  RgbImage ray_linear_;
  std::vector<PixelKind> ray_kind_;
  Srgb8Image screen_, part_;
  MeshKind kind_ = MeshKind::kFlat;
  double exposure_ = 1, scale_top_ = 1;
  ColourScale scale_ = ColourScale::kNone;
  FrameTimes times_;
};

// Exposure as MeterExposure() has it, from every kMeterStride-th pixel of every kMeterStride-th row.
double MeterSparsely(const RgbImage& linear, const std::vector<PixelKind>& kinds);
inline constexpr int kMeterStride = 4;

}  // namespace penumbra::viewer
