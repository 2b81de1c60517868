// What keys and mouse do to the picture (thesis B.3.1, B.4.6, B.4.9, B.4.10).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "display/viewer/selection.h"
#include "display/viewer/viewer.h"
#include "display/viewer/viewer_do.h"
#include "display/viewer/walk.h"
#include "solver/base/check.h"

namespace penumbra::viewer {
namespace {

constexpr double kDragBegins = 4;     // pixels: less is a click
constexpr double kDoubleClick = 0.4;  // seconds between two clicks that are one
constexpr double kZoomNotch = 1.1;    // by a notch of the wheel
constexpr double kZoomPicture = 8;    // by a drag over the height of the picture
constexpr double kWarpPicture = 90;   // degrees by the same
constexpr double kLookPicture = 2;    // radians by the same
constexpr double kTurnSpeed = 1.2;    // radians a second, with the pointer at the picture's border

bool IsFlyKey(const std::string& key) {
  constexpr const char* kKeys[] = {"w", "a", "s", "d", "q", "e", "up", "down", "left", "right"};
  return std::any_of(std::begin(kKeys), std::end(kKeys), [&](const char* k) { return key == k; });
}

}  // namespace

void Viewer::Handle(const InputEvent& event) {
  fresh_ = false;
  switch (event.kind) {
    case InputEvent::Kind::kKeyDown:
      KeyDown(event);
      break;
    case InputEvent::Kind::kKeyUp:
      held_.erase(event.key);
      break;
    case InputEvent::Kind::kText:
      break;
    case InputEvent::Kind::kMove:
      Move(event);
      break;
    case InputEvent::Kind::kButtonDown:
      ButtonDown(event);
      break;
    case InputEvent::Kind::kButtonUp:
      ButtonUp(event);
      break;
    case InputEvent::Kind::kScroll:
      if (view_.navigation == Navigation::kArcball)
        view_.camera = Zoom(view_.camera, std::pow(kZoomNotch, event.scroll));
      else
        view_.walk_speed = std::clamp(view_.walk_speed * std::pow(kZoomNotch, event.scroll), 1e-3, 1e4);
      break;
  }
}

void Viewer::KeyDown(const InputEvent& event) {
  if (view_.navigation == Navigation::kWalk && event.modifiers == kNoModifier && IsFlyKey(event.key)) {
    held_.insert(event.key);
    return;
  }
  // Who does not see the pointer may not know how to get it back.
  if (Looking() && event.key == "escape") {
    view_.mouse_look = false;
    return;
  }
  if (const MenuItem* item = menu_.FindKey({event.key, event.modifiers})) RunMenu(std::string(item->path));
}

void Viewer::ButtonDown(const InputEvent& event) {
  x_ = event.x;
  y_ = event.y;
  press_ = Press{event.button, event.x, event.y, event.modifiers};
  press_camera_ = view_.camera;
  drag_.reset();
  if (view_.navigation == Navigation::kArcball && event.button == MouseButton::kLeft)
    drag_.emplace(view_.camera, size_, event.x, event.y,
                  event.modifiers & kShift  ? ArcballConstraint::kViewerAxes
                  : event.modifiers & kCtrl ? ArcballConstraint::kSceneAxes
                                            : ArcballConstraint::kNone);
}

void Viewer::Move(const InputEvent& event) {
  const double dx = event.x - x_, dy = event.y - y_;
  x_ = event.x;
  y_ = event.y;
  if (Looking()) {
    view_.camera = Look(view_.camera, kLookPicture * dx / size_.height, -kLookPicture * dy / size_.height,
                        view_.up_axis);
    return;
  }
  if (!press_) return;
  if (std::hypot(x_ - press_->x, y_ - press_->y) >= kDragBegins) press_->moved = true;
  if (!press_->moved || view_.navigation != Navigation::kArcball) return;
  if (drag_) {
    view_.camera = drag_->At(x_, y_);
  } else if (press_->button == MouseButton::kMiddle) {
    const double up = (press_->y - y_) / size_.height;  // of the picture
    if (press_->modifiers & kShift)
      view_.camera = Zoom(press_camera_, std::pow(kZoomPicture, up));
    else if (press_->modifiers & kCtrl)
      view_.camera = Warp(press_camera_, press_camera_.vertical_fov + kWarpPicture * up);
    else
      view_.camera = Pan(press_camera_, size_, x_ - press_->x, y_ - press_->y);
  }
}

void Viewer::ButtonUp(const InputEvent& event) {
  Move(event);
  if (press_ && press_->button == event.button && !press_->moved)
    Do("Select", /*merge=*/false, [&] { Click(event); });
  press_.reset();
  drag_.reset();
}

// While walking, the buttons move; alt makes clicks of them.
void Viewer::Click(const InputEvent& event) {
  const unsigned modifiers = press_->modifiers;
  if (view_.navigation == Navigation::kWalk && !(modifiers & kAlt)) return;
  if (event.button == MouseButton::kRight) {
    Probe(event, (modifiers & kShift) != 0);
    return;
  }
  if (event.button != MouseButton::kLeft || !picture_.frame() || view_.split) return;
  const bool twice = clock_ - last_click_ < kDoubleClick &&
                     std::hypot(event.x - last_click_x_, event.y - last_click_y_) < kDragBegins;
  last_click_ = clock_;
  last_click_x_ = event.x;
  last_click_y_ = event.y;
  if (draws_line_) {
    if (const auto at = PointAt(*snapshot_->scene, picture_.drawn(), *picture_.frame(),
                                picture_.depth()->rays(), event.x, event.y))
      DrawLine(*at);
    return;
  }
  if (const Selection picked = PickLine(drawing_, *picture_.depth(), event.x, event.y)) {
    view_.selection = SelectLine(view_.selection, picked);
    return;
  }
  const auto at = PointAt(*snapshot_->scene, picture_.drawn(), *picture_.frame(), picture_.depth()->rays(),
                          event.x, event.y);
  if (at)
    view_.selection = SelectSurface(Context(), *at);
  else if (twice)
    Unselect();
}

// The first click sets an end of the line, the second the other.
void Viewer::DrawLine(const ProbedPoint& at) {
  if (!line_start_) {
    line_start_ = at;
    return;
  }
  const ProbedPoint start = *std::exchange(line_start_, std::nullopt);
  const Patch& patch = snapshot_->scene->patches[static_cast<std::size_t>(start.patch)];
  constexpr double kInPlane = 1e-6;  // of the scene's diagonal
  const double off = std::abs(patch.normal.dot(at.position - patch.vertex[0]));
  draws_line_ = false;
  if (off > kInPlane * snapshot_->scene->Diagonal())
    throw InputError("both ends of the line must lie on one face; draw it again");
  view_.line = PlotLine{start.patch, {start.position, at.position}};
}

std::string Viewer::Hover() const {
  const RenderedFrame* const frame = picture_.frame();
  if (!frame || view_.split || !(x_ >= 0 && y_ >= 0 && x_ < frame->width && y_ < frame->height)) return "";
  const auto pixel =
      static_cast<std::size_t>(y_) * static_cast<std::size_t>(frame->width) + static_cast<std::size_t>(x_);
  const std::uint32_t triangle = frame->triangle[pixel];
  const auto at = PointAt(*snapshot_->scene, picture_.drawn(), *frame, picture_.depth()->rays(), x_, y_);
  if (!at || triangle == kNoTriangle) return "";
  const Scene& scene = *snapshot_->scene;
  const Material& material = scene.MaterialOf(at->patch);
  std::string line = DescribePlace(*at, scene) + ", " + material.name;
  if (!picture_.previews()) {
    const Rgb light = picture_.drawn().irradiance[triangle].At(static_cast<double>(frame->s[pixel]),
                                                               static_cast<double>(frame->t[pixel]));
    line += view_.unit == LightUnit::kLux
                ? fmt::format(", {:.4g} lux", Lux(light.max(0.0)))
                : fmt::format(", irradiance {:.4g} {:.4g} {:.4g} W/m^2", light[0], light[1], light[2]);
  }
  return line + fmt::format(", triangle {}", triangle);
}

void Viewer::Probe(const InputEvent& event, bool backproject) {
  if (!picture_.frame() || view_.split) return;
  const auto at = PointAt(*snapshot_->scene, picture_.drawn(), *picture_.frame(), picture_.depth()->rays(),
                          event.x, event.y);
  (backproject ? view_.backprojection : view_.probe) = at;
  // What is told together is of one place.
  std::optional<ProbedPoint>& other = backproject ? view_.probe : view_.backprojection;
  if (other != at) other.reset();
}

void Viewer::Walk(double seconds) {
  double forward = 0, right = 0, upward = 0;
  const auto held = [&](const char* a, const char* b) {
    return held_.contains(a) || held_.contains(b) ? 1.0 : 0.0;
  };
  forward += held("w", "up") - held("s", "down");
  right += held("d", "right") - held("a", "left");
  upward += held("e", "e") - held("q", "q");
  if (press_ && !(press_->modifiers & kAlt)) {
    if (press_->button == MouseButton::kLeft) forward += 1;
    if (press_->button == MouseButton::kRight) forward -= 1;
    if (press_->button == MouseButton::kMiddle)
      view_.camera = Look(view_.camera, kTurnSpeed * seconds * (2 * x_ / size_.width - 1),
                          kTurnSpeed * seconds * (1 - 2 * y_ / size_.height), view_.up_axis);
  }
  const double step = view_.walk_speed * seconds;
  if (forward != 0 || right != 0 || upward != 0)
    view_.camera = Fly(view_.camera, step * forward, step * right, step * upward, view_.up_axis);
}

}  // namespace penumbra::viewer
