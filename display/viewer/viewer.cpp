#include "display/viewer/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "display/viewer/overlays.h"
#include "display/viewer/selection.h"
#include "display/viewer/viewer_do.h"
#include "display/viewer/walk.h"
#include "mesh/pipeline/link_options.h"
#include "solver/base/check.h"

namespace penumbra::viewer {
namespace {

constexpr const char* kNoMemory = "out of memory for what is drawn over the picture: ask for a coarser grid";

// A scene is crossed in some eight seconds, whatever its size; 2 m/s where it has none.
double WalkSpeedOf(const Scene& scene) {
  constexpr double kSecondsAcross = 8, kPlainSpeed = 2;
  const double diagonal = scene.Diagonal();
  if (!(diagonal > 0)) return kPlainSpeed;
  const double speed = std::clamp(diagonal / kSecondsAcross, 1e-3, 1e4);
  const double decade = std::pow(10, std::floor(std::log10(speed)));
  return std::round(speed / decade * 10) / 10 * decade;
}

}  // namespace

Viewer::Viewer(const OpenedScene& opened, ViewerOptions options)
    : options_(std::move(options)), session_(opened, options_.solving) {
  TakeOptions(opened);
  view_.mode = DrawMode::kInterpolant;
  snapshot_ = session_.snapshot();
  tools_ = ToolsMesh();
  AddViewSettings();
  AddSceneSettings();
  AddSolveSettings();
  AddLightSettings();
  AddStepSettings();
  AddFileSettings();
  AddMenus();
  ListCameras();
  Home();
  view_.walk_speed = WalkSpeedOf(*opened.scene);
  if (options_.solve && !opened.stored) session_.Converge();
}

void Viewer::Home() {
  GoTo(snapshot_->scene->cameras.empty() ? FrameScene(*snapshot_->scene) : snapshot_->scene->cameras.front());
}

void Viewer::GoTo(const Camera& camera) {
  ValidateCamera(camera);
  view_.camera = camera;
}

void Viewer::AddCamera(const Camera& camera) {
  std::erase_if(cameras_, [&](const Camera& c) { return c.name == camera.name; });
  cameras_.push_back(camera);
  AddCameraMenu();
}

void Viewer::Unselect() {
  view_.selection = {};
  view_.probe.reset();
  view_.backprojection.reset();
  view_.line.reset();
  line_start_.reset();
  draws_line_ = false;
}

// Tools speak of the triangles of the mode, and of the interpolants in modes without any (thesis B.4).
std::shared_ptr<const MeshState> Viewer::ToolsMesh() const {
  const MeshKind kind = MeshOf(view_.mode);
  if (kind != MeshKind::kFlat && snapshot_->Mesh(kind)) return snapshot_->Mesh(kind);
  if (snapshot_->Mesh(MeshKind::kInterpolant)) return snapshot_->Mesh(MeshKind::kInterpolant);
  return snapshot_->Mesh(MeshKind::kFlat);
}

OverlayContext Viewer::Context() const {
  return {*snapshot_, *tools_, view_.overlays, view_.selection, results_, view_.isolate};
}

void Viewer::Want(MeshKind kind) {
  if (!snapshot_->light || snapshot_->Mesh(kind)) return;
  if (kind == MeshKind::kInterpolant && snapshot_->complete) return;  // a limit ended it
  if (asked_.emplace(snapshot_->number, kind).second) session_.BuildMesh(kind);
}

// Meshes are built when the solver rests: the picture follows it with the leaves until then.
void Viewer::AskForMeshes() {
  if (stepping_ || session_.status().busy || session_.snapshot() != snapshot_) return;
  const bool tools = NeedsOf(view_.overlays).triangles;
  if (MeshOf(view_.mode) != MeshKind::kFlat) Want(MeshOf(view_.mode));
  if (view_.error_map || view_.probe || (tools && MeshOf(view_.mode) == MeshKind::kFlat))
    Want(MeshKind::kInterpolant);
  // Dimmers answer at once if the transport is kept before the first is touched.
  if (panels_.lamps && snapshot_->complete && light_.empty() && ready_for_light_ != snapshot_->light) {
    ready_for_light_ = snapshot_->light;
    session_.SetLight(light_);
  }
}

std::string Viewer::activity() {
  if (draws_line_) return line_start_ ? "click the other end of the line" : "click one end of the line";
  if (picture_.Busy()) return fmt::format("casting rays, {:.0f} %", 100 * picture_.RayFraction());
  if (analyses_.Busy()) return "analysing";
  if (!snapshot_->light) return "not solved: reflectances, i or c solves";
  if (stepping_) return fmt::format("step {} of {}", step(), session_.steps()->size());
  if (!snapshot_->Mesh(MeshOf(view_.mode))) return "the leaves: no mesh was made";
  const bool on_the_way =
      MeshOf(view_.mode) == MeshKind::kInterpolant && snapshot_->converged && !snapshot_->complete;
  return on_the_way ? "the mesh is not refined to its end" : "ready";
}

// What goes wrong in the session is told once.
void Viewer::HearSession() {
  if (!HasNews()) return;
  heard_ = session_.status().message;
  Complain(heard_);
}

bool Viewer::HasNews() const {
  const std::string message = session_.status().message;
  return !message.empty() && message != heard_;
}

SolverSession& Viewer::Begin() {
  Dismiss();
  heard_.clear();
  return session_;
}

const Srgb8Image& Viewer::Frame(int width, int height, double seconds) {
  size_ = {width, height};
  clock_ += seconds;
  seconds_a_frame_ = seconds_a_frame_ > 0 ? 0.9 * seconds_a_frame_ + 0.1 * seconds : seconds;
  if (view_.navigation == Navigation::kWalk) Walk(seconds);

  const std::shared_ptr<const Snapshot> latest = session_.snapshot();
  if (latest->opening != snapshot_->opening) {
    snapshot_ = latest;
    Unselect();
    ListCameras();
    if (!keep_camera_) Home();
    view_.walk_speed = WalkSpeedOf(*snapshot_->scene);
  }
  snapshot_ = latest;
  HearSession();
  Play();
  AskForMeshes();
  const std::shared_ptr<const MeshState> tools = ToolsMesh();
  // Numbers of links, triangles and discontinuities are those of one state; elements keep theirs.
  if (tools != tools_ && view_.selection.kind == SelectionKind::kTriangle) view_.selection = {};
  tools_ = tools;
  if (drawn_of_ && drawn_of_->snapshot->light != snapshot_->light &&
      view_.selection.kind != SelectionKind::kElement && view_.selection.kind != SelectionKind::kObject &&
      view_.selection.kind != SelectionKind::kMaterial)
    view_.selection = {};
  results_ = analyses_.Update(*snapshot_, tools_, view_);
  if (analyses_.RanOutOfMemory()) Complain(kNoMemory);
  if (view_.selection &&
      !(view_.selection.kind == SelectionKind::kDiscontinuity && !results_.discontinuities) &&
      !IsValid(Context(), view_.selection))
    view_.selection = {};
  if (results_.probe && results_.probe != printed_probe_) {
    printed_probe_ = results_.probe;
    if (options_.print) {
      if (printed_++ == 0) options_.print(kProbeHeader);
      options_.print(ProbeLine(*results_.probe));
    }
  }

  DrawnOf now{snapshot_, tools_, view_.overlays, view_.selection, view_.isolate, results_};
  if (!(drawn_of_ == now)) {
    DrawOverlays();
    drawn_of_ = std::move(now);
  }
  picture_.Make(Context(), view_, drawing_, width, height);
  if (!picture_.backend_error().empty()) {
    Complain(picture_.backend_error());
    view_.backend = Backend::kSoftware;
  }
  fresh_ = true;
  if (compares_ && comparison_.HasKept() && !view_.split)
    return comparison_.Draw(picture_, view_, compare_at_);
  return picture_.screen();
}

// What there is no memory for is left out: the solution is worth more.
void Viewer::DrawOverlays() {
  drawing_ = {};
  try {
    drawing_ = viewer::DrawOverlays(Context());
  } catch (const std::bad_alloc&) {
    drawing_ = {};
    Complain(kNoMemory);
  }
}

bool Viewer::Idle() {
  if (playing_ || session_.status().busy || analyses_.Busy() || picture_.Busy() || !fresh_) return false;
  // A result that came since the last frame has to be drawn first, and may ask for more.
  if (session_.snapshot() != snapshot_ || HasNews()) return false;
  AskForMeshes();
  if (session_.status().busy) return false;
  return results_ == analyses_.Update(*snapshot_, tools_, view_) && !analyses_.Busy();
}

void Viewer::RunMenu(const std::string& path) {
  fresh_ = false;
  const MenuItem* item = menu_.Find(path);
  if (!item) throw InputError(fmt::format("there is no menu item '{}'; --help-script lists them", path));
  // A copy: the item may replace itself.
  const std::function<void()> run = item->run;
  if (path.starts_with("Edit/"))
    run();
  else
    Do(path.substr(path.rfind('/') + 1), /*merge=*/false, run);
}

void Viewer::Set(const std::string& name, const std::string& value, bool merge) {
  fresh_ = false;
  const Setting* setting = settings_.Find(name);
  if (!setting) throw InputError(fmt::format("there is no option '{}'; --help-script lists them", name));
  if (own_links_ && IsLinkOption(name))
    throw InputError(
        fmt::format("{}: it says how links are made, but restart keeps those of a solution", name));
  try {
    Do(setting->help, merge, [&] { setting->set(value); });
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", name, error.what()));
  }
}

std::vector<std::string> Viewer::Details() const {
  std::vector<std::string> lines = DescribeSelection(Context());
  if (results_.probe) {
    if (!lines.empty()) lines.emplace_back();
    lines.emplace_back("irradiance probe");
    for (std::string& line : DescribeProbe(*results_.probe, *snapshot_->scene))
      lines.push_back(std::move(line));
  }
  if (results_.backprojection && view_.backprojection) {
    if (!lines.empty()) lines.emplace_back();
    std::size_t hidden = 0;
    for (const BackprojectedPatch& patch : *results_.backprojection) hidden += patch.visible.empty() ? 1 : 0;
    lines.push_back(fmt::format("backprojection on {} sources, {} of them hidden",
                                results_.backprojection->size(), hidden));
    lines.push_back(DescribePlace(*view_.backprojection, *snapshot_->scene));
  }
  if (compares_ && comparison_.HasKept()) {
    if (!lines.empty()) lines.emplace_back();
    lines.push_back(TextOf(comparison_.difference()));
  }
  return lines;
}

}  // namespace penumbra::viewer
