// What the viewer opens and saves.

#include <fmt/format.h>

#include <utility>

#include "display/false_colour.h"
#include "display/image_writers.h"
#include "display/ray_display.h"
#include "display/viewer/viewer.h"
#include "mesh/pipeline/link_options.h"
#include "solver/base/check.h"
#include "solver/base/file_endings.h"
#include "solver/base/whole_file.h"
#include "solver/scene/named_scene.h"

namespace penumbra::viewer {
namespace {

void RequireName(const std::string& path) {
  if (!FindByEnding(ImageWriters(), path)) throw InputError(EndingError(path, ImageWriters().Names()));
}

// Lines and points that stay as wide once k x k pixels have become one.
OverlayDrawing Widened(OverlayDrawing drawing, int k) {
  for (OverlayLine& line : drawing.lines) line.width *= static_cast<float>(k);
  for (OverlayPoint& point : drawing.points) point.radius *= static_cast<float>(k);
  return drawing;
}

void WriteWithLegend(const std::string& path, const PictureMaker& picture, Srgb8Image* screen) {
  if (picture.scale() != ColourScale::kNone)
    PaintLegend(picture.scale_values(), UnitOf(picture.scale()), screen);
  WriteImageFile(path, *screen);
}

}  // namespace

void Viewer::Open(const std::string& name) {
  const OpenedScene opened = options_.files.open
                                 ? options_.files.open(name)
                                 : OpenedScene(std::make_shared<const Scene>(ReadNamedScene(name, {})));
  options_.scene_name = name;
  keep_camera_ = false;
  Take(opened);
  if (options_.opened) options_.opened(name);
}

// A solution brings all of its options. Links bring those that say how they were made, until there are none
// any more.
void Viewer::TakeOptions(const OpenedScene& opened) {
  PipelineOptions& solving = options_.solving;
  const std::optional<PipelineOptions> own = std::exchange(own_links_, std::nullopt);
  if (opened.stored) {
    solving = opened.solving;
    return;
  }
  if (opened.restart) own_links_ = own.value_or(solving);
  if (!opened.restart && !own) return;
  TakeLinkOptions(opened.restart ? opened.solving : *own, &solving);
  SolvingChanged();
}

void Viewer::Take(const OpenedScene& opened) {
  TakeOptions(opened);
  light_ = {};
  stepping_ = playing_ = false;
  Change().SetScene(opened);
  if (options_.solve && !opened.stored) Begin().Converge();
}

// Each reads the scene anew, which is seen from where one stands.
void Viewer::AddSceneSettings() {
  for (const ReadingOption& option : options_.files.reading) {
    Setting setting{option.name, "Scene", option.help, SettingKind::kText, 0, 1, false, false, {}, {}, {}};
    if (option.toggle) {
      setting.kind = SettingKind::kToggle;
      setting.choices = {"off", "on"};
    }
    setting.get = option.value;
    setting.set = [this, option](const std::string& text) {
      if (text == option.value()) return;
      const OpenedScene opened = options_.files.read_with(option.name, text);
      keep_camera_ = true;
      Take(opened);
    };
    settings_.Add(std::move(setting));
  }
}

// Those of the scene, then those that users named.
void Viewer::ListCameras() {
  cameras_ = snapshot_->scene->cameras;
  if (options_.kept_cameras)
    for (const Camera& camera : options_.kept_cameras(options_.scene_name)) AddCamera(camera);
  AddCameraMenu();
}

void Viewer::SaveCamera(const std::string& name) {
  if (name.empty() || name.find_first_of("/\t\n") != name.npos)
    throw InputError("a camera's name has a letter or more, and no /");
  Camera camera = view_.camera;
  camera.name = name;
  AddCamera(camera);
  if (options_.keep_camera) options_.keep_camera(options_.scene_name, camera);
}

void Viewer::SavePicture(const std::string& path) {
  RequireName(path);
  if (!picture_.frame()) throw InputError("there is no picture yet");
  if (picture_.by_rays()) return SaveRayPicture(path);
  if (IsLinearImage(path)) return WriteImageFile(path, picture_.linear());
  const int k = view_.split ? 1 : view_.supersampling;
  if (k * std::max(size_.width, size_.height) > kMaxPictureSize)
    throw InputError("the picture would be too large; ask for less supersampling");
  if (k > 1) return SaveLargerPicture(path, k);
  Srgb8Image screen = picture_.screen();
  WriteWithLegend(path, picture_, &screen);
}

// Drawn k times as large, lines too, and averaged; beside the view, for it takes a while.
void Viewer::SaveLargerPicture(const std::string& path, int k) {
  Begin().Run("render", [=, now = snapshot_, tools = tools_, view = view_, results = results_,
                         drawing = Widened(drawing_, k),
                         size = size_](const Snapshot&, const ExecutionContext&) {
    PictureMaker larger;
    const OverlayContext context{*now, *tools, view.overlays, view.selection, results, view.isolate};
    Srgb8Image screen = ShrinkScreen(larger.Make(context, view, drawing, k * size.width, k * size.height), k);
    WriteWithLegend(path, larger, &screen);
  });
}

// As `render` draws it: so many rays a pixel, without overlays, beside the view.
void Viewer::SaveRayPicture(const std::string& path) {
  const bool exact = view_.mode == DrawMode::kExact;
  const ViewState view = view_;
  const double exposure = picture_.exposure();
  const FalseColourScale scale = picture_.scale_values();
  const ColourScale shown = picture_.scale();
  Begin().Run(
      "render", [=, size = size_, light = snapshot_->light, mesh = snapshot_->Mesh(MeshKind::kInterpolant)](
                    const Snapshot&, const ExecutionContext& context) {
        const Scene& scene = light->scene();
        const std::optional<Reconstruction> kind = ReconstructionOf(view.mode);
        const auto reconstructed = kind ? light->Reconstructed(*kind, context) : nullptr;
        if (kind && !reconstructed) return;
        RayDisplay display(scene,
                           reconstructed ? reconstructed->Shade(view.camera, size.width, size.height)
                           : exact       ? RayShade(scene, light->Exact())
                                         : LerpShade(scene, mesh->mesh()),
                           view.supersampling * view.supersampling);
        const SampledPicture& picture = display.Render(view.camera, size.width, size.height, context);
        if (context.Cancelled()) return;
        if (IsLinearImage(path)) return WriteImageFile(path, Downsample(picture.linear, picture.samples, 1));
        Srgb8Image screen;
        if (view.false_colour) {
          std::vector<PixelKind> first;
          for (std::size_t i = 0; i < picture.kind.size(); i += static_cast<std::size_t>(picture.samples))
            first.push_back(picture.kind[i]);
          PaintFalseColours(Downsample(picture.linear, picture.samples, 1), first, scale, &screen);
          PaintLegend(scale, UnitOf(shown), &screen);
        } else {
          EncodeSrgb(Expose(picture.linear, picture.kind, exposure, picture.samples), true, &screen);
        }
        WriteImageFile(path, screen);
      });
}

void Viewer::SaveLine(const std::string& path) {
  if (!results_.line_plot) throw InputError("no line is drawn, or its light is still being computed");
  WriteWholeFile(path, LinePlotCsv(*results_.line_plot));
}

void Viewer::SaveSolved(const std::string& path, const ViewerFiles::WriteSolved& write) {
  if (!write) throw InputError("there is nobody who writes it");
  Begin().Save([path, write, lit_as = options_.files.lit_as, light = light_](const Pipeline& pipeline) {
    if (lit_as) lit_as(light);
    write(path, pipeline);
  });
}

void Viewer::Export(const std::string& path) {
  const ViewerFiles& files = options_.files;
  if (!files.exports_mesh || !files.export_file) throw InputError("there is nobody who exports");
  const bool wants_mesh = files.exports_mesh(path);
  if (wants_mesh && !snapshot_->light) throw InputError("nothing is solved yet: iterate first");
  if (wants_mesh) Begin().BuildMesh(MeshKind::kInterpolant);
  Begin().Run("export", [path, wants_mesh, write = files.export_file, camera = view_.camera](
                            const Snapshot& now, const ExecutionContext& context) {
    const auto& mesh = now.Mesh(MeshKind::kInterpolant);
    if (context.Cancelled() || (wants_mesh && !mesh)) return;
    write(path, *now.scene, wants_mesh ? &mesh->mesh() : nullptr, camera);
  });
}

}  // namespace penumbra::viewer
