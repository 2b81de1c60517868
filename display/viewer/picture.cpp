#include "display/viewer/picture.h"

#include <algorithm>
#include <cmath>

#include "display/false_colour.h"
#include "display/opengl_passes.h"
#include "display/split_view.h"
#include "display/viewer/mesh_tools.h"
#include "display/viewer/selection.h"
#include "solver/base/check.h"

namespace penumbra::viewer {

MeshKind MeshOf(DrawMode mode) {
  switch (mode) {
    case DrawMode::kFlat:
    case DrawMode::kRho:
    case DrawMode::kNodal:
    case DrawMode::kGouraudScreen:
    case DrawMode::kBilinear:
    case DrawMode::kBicubic:
      return MeshKind::kFlat;
    case DrawMode::kGouraud:
      return MeshKind::kGouraud;
    case DrawMode::kGouraudMesh:
      return MeshKind::kGouraudMesh;
    case DrawMode::kInterpolant:
    case DrawMode::kExact:
    case DrawMode::kLerp:
      break;
  }
  return MeshKind::kInterpolant;
}

std::optional<Reconstruction> ReconstructionOf(DrawMode mode) {
  if (mode == DrawMode::kNodal) return Reconstruction::kNodal;
  if (mode == DrawMode::kGouraudScreen) return Reconstruction::kGouraudScreen;
  if (mode == DrawMode::kBilinear) return Reconstruction::kBilinear;
  if (mode == DrawMode::kBicubic) return Reconstruction::kBicubic;
  return std::nullopt;
}

const char* UnitOf(ColourScale scale) {
  switch (scale) {
    case ColourScale::kNone:
      break;
    case ColourScale::kIrradiance:
      return "W/m^2";
    case ColourScale::kLux:
      return "lux";
    case ColourScale::kError:
      return "rel. error";
  }
  return "";
}

double MeterSparsely(const RgbImage& linear, const std::vector<PixelKind>& kinds) {
  const int columns = (linear.width + kMeterStride - 1) / kMeterStride;
  const int rows = (linear.height + kMeterStride - 1) / kMeterStride;
  RgbImage sparse(columns, rows);
  std::vector<PixelKind> sparse_kinds(sparse.PixelCount());
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      sparse.Set(x, y, linear.At(kMeterStride * x, kMeterStride * y));
      sparse_kinds[sparse.Index(x, y)] = kinds[linear.Index(kMeterStride * x, kMeterStride * y)];
    }
  return MeterExposure(sparse, sparse_kinds);
}

namespace {

// The even light of the preview: nearly the same from all sides, but not quite, so that faces of one
// reflectance that meet at an edge differ.
Rgb EvenLight(const Vec3& normal) {
  constexpr double kMean = 0.8, kAcross = 0.06, kAlong = 0.03, kUp = 0.11;
  return Rgb::Constant(kMean + kAcross * normal.x() + kAlong * normal.y() + kUp * normal.z());
}

bool HasGathered(const Snapshot& snapshot) {
  return snapshot.light && (!snapshot.iterations.empty() || snapshot.begun || snapshot.converged ||
                            snapshot.light->solution().links.links.empty());
}

}  // namespace

void PictureMaker::UpdatePreview(const OverlayContext& context) {
  previews_ = !HasGathered(context.snapshot);
  const std::shared_ptr<const MeshState>& flat = context.snapshot.Mesh(MeshKind::kFlat);
  if (!previews_ || preview_of_ == flat) return;
  IrradianceMesh mesh = flat->mesh();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto patch = static_cast<std::size_t>(mesh.triangles[i].patch);
    mesh.irradiance[i] = QuadraticInterpolant();
    mesh.irradiance[i].f = EvenLight(context.snapshot.scene->patches[patch].normal);
  }
  preview_ = std::make_shared<const MeshState>(context.snapshot.scene, std::move(mesh));
  preview_of_ = flat;
}

void PictureMaker::ChooseMesh(const OverlayContext& context, const ViewState& view) {
  kind_ = view.error_map && context.results.error_map ? MeshKind::kInterpolant : MeshOf(view.mode);
  std::shared_ptr<const MeshState> wanted = context.snapshot.Mesh(kind_);
  if (!wanted) {
    kind_ = MeshKind::kFlat;
    wanted = context.snapshot.Mesh(kind_);
  }
  UpdatePreview(context);
  if (previews_) wanted = preview_;
  // Rays meet the whole scene. A triangle is one of the tools' mesh.
  const bool isolate = view.isolate && context.selection && !(CastsRays(view.mode) && !view.error_map);
  if (isolate && context.selection.kind == SelectionKind::kTriangle)
    for (const auto& mesh : context.snapshot.mesh)
      if (mesh.get() == &context.mesh) wanted = mesh;
  const Selection isolated = isolate ? context.selection : Selection{};
  const bool same_results = isolated.kind != SelectionKind::kDiscontinuity || isolated_by_ == context.results;
  if (wanted == whole_ && isolated == isolated_ && view.hidden == hidden_ && same_results &&
      view.backend == backend_ && view.coordinates == coordinates_ && display_)
    return;
  backend_ = view.backend;
  coordinates_ = view.coordinates;
  whole_ = wanted;
  isolated_ = isolated;
  isolated_by_ = context.results;
  hidden_ = view.hidden;
  ChoosePart(context);
  display_.emplace(*context.snapshot.scene, drawn_->mesh(), MakePasses());
}

// What is drawn of the mesh: all of it, the selection alone, or what is not hidden.
void PictureMaker::ChoosePart(const OverlayContext& context) {
  drawn_ = whole_;
  const IrradianceMesh& mesh = whole_->mesh();
  if (isolated_) {
    left_ = IsolatedTriangles(context, mesh);
  } else if (!hidden_.empty()) {
    left_.clear();
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto patch = static_cast<std::size_t>(mesh.triangles[i].patch);
      if (!hidden_.contains(context.snapshot.scene->patches[patch].object)) left_.push_back(i);
    }
  } else {
    return;
  }
  drawn_ = std::make_shared<const MeshState>(context.snapshot.scene, SubMesh(mesh, left_));
}

// Of what is drawn; the rasteriser's where there is no OpenGL.
std::unique_ptr<Passes> PictureMaker::MakePasses() {
  backend_error_.clear();
  if (backend_ == Backend::kOpenGl) {
    try {
      return OpenGlPasses(drawn_->mesh(), coordinates_);
    } catch (const InputError& error) {
      backend_error_ = error.what();
    }
  }
  return SoftwarePasses(drawn_->mesh());
}

// Whether the errors are those of the triangles that are drawn.
bool PictureMaker::Shows(const ErrorMap* errors) const {
  return errors && errors->error.size() == whole_->mesh().triangles.size();
}

void PictureMaker::PaintErrors(const ErrorMap& errors, double top, Srgb8Image* out) const {
  const RenderedFrame& frame = display_->frame();
  for (std::size_t i = 0; i < frame.triangle.size(); ++i) {
    const std::uint32_t drawn = frame.triangle[i];
    if (drawn == kNoTriangle) continue;
    const std::uint32_t triangle = drawn_ == whole_ ? drawn : left_[drawn];
    SetPixel(out, i, FalseColour(static_cast<double>(errors.error[triangle]) / top));
  }
}

// Modes that cast rays have the passes' picture until the rays are there.
void PictureMaker::CastRays(const OverlayContext& context, const ViewState& view, int width, int height) {
  const bool lerp = view.mode == DrawMode::kLerp;
  const auto& interpolants = context.snapshot.Mesh(MeshKind::kInterpolant);
  by_rays_ = CastsRays(view.mode) && !view.error_map && context.snapshot.light && !previews_ &&
             (!lerp || interpolants);
  if (!by_rays_) {
    rays_.Clear();
    return;
  }
  rays_.Show({context.snapshot.light, lerp ? interpolants : nullptr, view.camera, width, height,
              ReconstructionOf(view.mode)});
  ray_linear_ = display_->frame().linear;
  ray_kind_ = display_->frame().kind;
  rays_.Paint(&ray_linear_, &ray_kind_);
}

// From the last frame to the screen.
void PictureMaker::Shade(const OverlayContext& context, const ViewState& view, Srgb8Image* out) {
  const std::vector<PixelKind>& kinds = by_rays_ ? ray_kind_ : display_->frame().kind;
  const bool rho = view.mode == DrawMode::kRho || (view.mode == DrawMode::kFlat && view.trees_by_reflectance);
  exposure_ = rho || previews_ ? 1 : view.auto_exposure ? MeterSparsely(linear(), kinds) : view.exposure;
  const bool errors = view.error_map && Shows(context.results.error_map.get());
  const ColourScale light = view.unit == LightUnit::kLux ? ColourScale::kLux : ColourScale::kIrradiance;
  const bool false_colours = view.false_colour && !rho && !previews_;
  scale_ = errors ? ColourScale::kError : false_colours ? light : ColourScale::kNone;
  scale_values_ = {1, view.unit, view.false_colour_log};
  if (errors) {
    scale_values_ = {view.error_map_max};
    *out = display_->ToneMap({exposure_, true}).screen;
    PaintErrors(*context.results.error_map, scale_values_.top, out);
  } else if (false_colours) {
    scale_values_.top =
        view.false_colour_max > 0 ? view.false_colour_max : RangeOf(linear(), kinds, view.unit);
    PaintFalseColours(linear(), kinds, scale_values_, out);
  } else if (by_rays_) {
    ToneMap(linear(), kinds, {exposure_, true}, out);
  } else {
    *out = display_->ToneMap({exposure_, true}).screen;
  }
  times_ = display_->frame().ms;
}

const Srgb8Image& PictureMaker::Make(const OverlayContext& context, const ViewState& view,
                                     const OverlayDrawing& drawing, int width, int height) {
  PENUMBRA_CHECK(width > 0 && height > 0);
  ChooseMesh(context, view);
  const int w = view.split ? std::max(1, width / 2) : width,
            h = view.split ? std::max(1, height / 2) : height;
  const PixelRays rays = MakePixelRays(view.camera, w, h);
  const bool rho = view.mode == DrawMode::kRho || (view.mode == DrawMode::kFlat && view.trees_by_reflectance);
  display_->Render(view.camera, w, h, rho ? ShadingMode::kReflectance : ShadingMode::kRadiosity);
  CastRays(context, view, w, h);
  const bool see_through = !view.faces || view.overlays.hidden_lines;
  depth_.emplace(rays, display_->frame(), drawn_->mesh());
  if (view.split) {
    Shade(context, view, &part_);
    screen_.Resize(width, height);
    PaintSplit(display_->frame(), rays, drawn_->mesh(), part_, &screen_);
    return screen_;
  }
  Shade(context, view, &screen_);
  if (!view.faces) {
    const auto grey = static_cast<std::uint8_t>(28);
    std::fill(screen_.pixels.begin(), screen_.pixels.end(), grey);
  }
  if (see_through) depth_.emplace(rays, w, h);
  PaintOverlay(drawing, *depth_, &screen_);
  return screen_;
}

}  // namespace penumbra::viewer
