#include "display/viewer/arcball.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "display/camera.h"
#include "display/glm_conversion.h"
#include "display/unit_vectors.h"

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
glm::dmat3 ViewerAxes(const Camera& camera) {
  const PixelRays rays = MakePixelRays(camera, 1, 1);
  const glm::dvec3 right = Normalized(rays.dx), up = -Normalized(rays.dy);
  return {right, up, glm::cross(right, up)};
}

// The point of the great circle about the axis that is nearest to p.
glm::dvec3 OnCircle(const glm::dvec3& p, const glm::dvec3& axis) {
  const glm::dvec3 in_plane = p - glm::dot(p, axis) * axis;
  if (glm::length(in_plane) < 1e-9) return Perpendicular(axis);
  return Normalized(in_plane.z < 0 ? -in_plane : in_plane);
}

double HalfTangent(const Camera& camera) { return std::tan(camera.vertical_fov * (std::numbers::pi / 360)); }

}  // namespace

ArcballDrag::ArcballDrag(const Camera& camera, PictureSize size, double x, double y,
                         ArcballConstraint constraint)
    : start_(camera), size_(size), axes_(ViewerAxes(camera)), from_(OnBall(x, y)) {
  if (constraint == ArcballConstraint::kNone) return;
  double nearest = -2;
  // The axes that it may turn about, as the viewer sees them.
  const glm::dmat3 choices =
      constraint == ArcballConstraint::kViewerAxes ? glm::dmat3(1.0) : glm::transpose(axes_);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3& axis = choices[i];
    const double cosine = glm::dot(OnCircle(from_, axis), from_);
    if (cosine > nearest) {
      nearest = cosine;
      constraint_ = axis;
    }
  }
  from_ = OnCircle(from_, *constraint_);
}

glm::dvec3 ArcballDrag::OnBall(double x, double y) const {
  const double radius = 0.5 * kBallOfPicture * std::min(size_.width, size_.height);
  glm::dvec3 p((x - 0.5 * size_.width) / radius, (0.5 * size_.height - y) / radius, 0);
  const double square = glm::dot(p, p);
  if (square > 1) return Normalized(p);
  p.z = std::sqrt(1 - square);
  return p;
}

Camera ArcballDrag::At(double x, double y) const {
  glm::dvec3 to = OnBall(x, y);
  if (constraint_) to = OnCircle(to, *constraint_);
  // Twice the arc, as Shoemake has it: the quaternion (from . to, from x to).
  const glm::dquat turn(glm::dot(from_, to), glm::cross(from_, to));
  // The model turns by `turn` in the viewer's axes; the camera by its inverse.
  const glm::dmat3 rotation =
      axes_ * glm::transpose(glm::mat3_cast(glm::normalize(turn))) * glm::transpose(axes_);
  Camera camera = start_;
  camera.eye = start_.look_at + ToEigen(rotation * ToGlm(start_.eye - start_.look_at));
  camera.up = ToEigen(rotation * axes_[1]);
  return camera;
}

Camera Pan(const Camera& camera, PictureSize size, double dx, double dy) {
  const PixelRays rays = MakePixelRays(camera, size.width, size.height);
  const double depth = glm::length(ToGlm(camera.look_at) - rays.eye);
  const Vec3 shift = ToEigen(-depth * (dx * rays.dx + dy * rays.dy));
  Camera moved = camera;
  moved.eye += shift;
  moved.look_at += shift;
  return moved;
}

Camera Zoom(const Camera& camera, double factor) {
  const glm::dvec3 look_at = ToGlm(camera.look_at), back = ToGlm(camera.eye) - look_at;
  const double distance = glm::length(back);
  const double nearest = std::max(kNearestZoom * MaxAbs(camera.look_at), 1 / kFarthestZoom);
  Camera moved = camera;
  moved.eye = ToEigen(look_at + back * (std::clamp(distance / factor, std::min(nearest, distance),
                                                   std::max(kFarthestZoom, distance)) /
                                        distance));
  return moved;
}

Camera Warp(const Camera& camera, double vertical_fov) {
  Camera warped = camera;
  warped.vertical_fov = std::clamp(vertical_fov, kMinFov, kMaxFov);
  return Zoom(warped, HalfTangent(warped) / HalfTangent(camera));
}

}  // namespace penumbra::viewer
