#include "display/viewer/walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra::viewer {
namespace {

constexpr double kSteepest = 0.99 * (std::numbers::pi / 2);  // elevation of the view [radians]

Vec3 RightOf(const Vec3& forward, const Vec3& up) {
  const Vec3 right = forward.cross(up);
  return right.norm() > 0 ? Vec3(right.normalized()) : Vec3(up.unitOrthogonal());
}

}  // namespace

Camera Fly(const Camera& camera, double forward, double right, double upward, const Vec3& up) {
  const Vec3 ahead = (camera.look_at - camera.eye).normalized();
  const Vec3 shift = forward * ahead + right * RightOf(ahead, up) + upward * up;
  Camera moved = camera;
  moved.eye += shift;
  moved.look_at += shift;
  return moved;
}

Camera Look(const Camera& camera, double right, double upward, const Vec3& up) {
  const double distance = (camera.look_at - camera.eye).norm();
  const Vec3 ahead = (camera.look_at - camera.eye) / distance;
  const double elevation = std::asin(std::clamp(ahead.dot(up), -1.0, 1.0));
  const double raised = std::clamp(elevation + upward, -kSteepest, kSteepest);
  // Along the ground, where the view is not straight up or down.
  Vec3 level = up.cross(RightOf(ahead, up));
  level = Eigen::AngleAxisd(-right, up) * level.normalized();
  Camera turned = camera;
  turned.look_at = camera.eye + distance * (std::cos(raised) * level + std::sin(raised) * up);
  turned.up = up;
  return turned;
}

}  // namespace penumbra::viewer
