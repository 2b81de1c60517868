#include "display/viewer/arcball.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "display/camera.h"

namespace penumbra::viewer {
namespace {

// Part of the smaller side of the picture that the ball fills.
constexpr double kBallOfPicture = 0.9;

// How far away from look_at zooming goes [m]: as far as coordinates may be given.
constexpr double kFarthestZoom = 1e12;
// And how near, as part of look_at's largest coordinate: of the 53 digits of the view's direction, rounding
// of the eye leaves 20, a pixel of a million.
constexpr double kNearestZoom = 0x1p-32;

// Columns: right, up, backward, as the display takes them.
Eigen::Matrix3d ViewerAxes(const Camera& camera) {
  const PixelRays rays = MakePixelRays(camera, 1, 1);
  Eigen::Matrix3d axes;
  axes.col(0) = rays.dx.normalized();
  axes.col(1) = -rays.dy.normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

// The point of the great circle about the axis that is nearest to p.
Vec3 OnCircle(const Vec3& p, const Vec3& axis) {
  const Vec3 in_plane = p - p.dot(axis) * axis;
  if (in_plane.norm() < 1e-9) return axis.unitOrthogonal();
  return (in_plane.z() < 0 ? Vec3(-in_plane) : in_plane).normalized();
}

double HalfTangent(const Camera& camera) { return std::tan(camera.vertical_fov * (std::numbers::pi / 360)); }

}  // namespace

ArcballDrag::ArcballDrag(const Camera& camera, PictureSize size, double x, double y,
                         ArcballConstraint constraint)
    : start_(camera), size_(size), axes_(ViewerAxes(camera)), from_(OnBall(x, y)) {
  if (constraint == ArcballConstraint::kNone) return;
  double nearest = -2;
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = constraint == ArcballConstraint::kViewerAxes ? Vec3(Vec3::Unit(i))
                                                                   : Vec3(axes_.transpose() * Vec3::Unit(i));
    const double cosine = OnCircle(from_, axis).dot(from_);
    if (cosine > nearest) {
      nearest = cosine;
      constraint_ = axis;
    }
  }
  from_ = OnCircle(from_, *constraint_);
}

Vec3 ArcballDrag::OnBall(double x, double y) const {
  const double radius = 0.5 * kBallOfPicture * std::min(size_.width, size_.height);
  Vec3 p((x - 0.5 * size_.width) / radius, (0.5 * size_.height - y) / radius, 0);
  const double square = p.squaredNorm();
  if (square > 1) return p.normalized();
  p.z() = std::sqrt(1 - square);
  return p;
}

Camera ArcballDrag::At(double x, double y) const {
  Vec3 to = OnBall(x, y);
  if (constraint_) to = OnCircle(to, *constraint_);
  // Twice the arc, as Shoemake has it: the quaternion (from . to, from x to).
  const Eigen::Quaterniond turn(from_.dot(to), from_.cross(to).x(), from_.cross(to).y(), from_.cross(to).z());
  // The model turns by `turn` in the viewer's axes; the camera by its inverse.
  const Eigen::Matrix3d rotation =
      axes_ * turn.normalized().toRotationMatrix().transpose() * axes_.transpose();
  Camera camera = start_;
  camera.eye = start_.look_at + rotation * (start_.eye - start_.look_at);
  camera.up = rotation * axes_.col(1);
  return camera;
}

Camera Pan(const Camera& camera, PictureSize size, double dx, double dy) {
  const PixelRays rays = MakePixelRays(camera, size.width, size.height);
  const double depth = (camera.look_at - camera.eye).norm();
  const Vec3 shift = -depth * (dx * rays.dx + dy * rays.dy);
  Camera moved = camera;
  moved.eye += shift;
  moved.look_at += shift;
  return moved;
}

Camera Zoom(const Camera& camera, double factor) {
  const Vec3 back = camera.eye - camera.look_at;
  const double distance = back.norm();
  const double nearest = std::max(kNearestZoom * camera.look_at.lpNorm<Eigen::Infinity>(), 1 / kFarthestZoom);
  Camera moved = camera;
  moved.eye = camera.look_at + back * (std::clamp(distance / factor, std::min(nearest, distance),
                                                  std::max(kFarthestZoom, distance)) /
                                       distance);
  return moved;
}

Camera Warp(const Camera& camera, double vertical_fov) {
  Camera warped = camera;
  warped.vertical_fov = std::clamp(vertical_fov, kMinFov, kMaxFov);
  return Zoom(warped, HalfTangent(warped) / HalfTangent(camera));
}

}  // namespace penumbra::viewer
