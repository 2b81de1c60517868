#include "display/viewer/walk.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "display/glm_conversion.h"
#include "display/unit_vectors.h"

namespace penumbra::viewer {
namespace {

constexpr double kSteepest = 0.99 * (std::numbers::pi / 2);  // elevation of the view [radians]

// From the eye to the point looked at.
glm::dvec3 ViewOf(const Camera& camera) { return ToGlm(camera.look_at) - ToGlm(camera.eye); }

glm::dvec3 RightOf(const glm::dvec3& forward, const glm::dvec3& up) {
  const glm::dvec3 right = glm::cross(forward, up);
  return glm::length(right) > 0 ? Normalized(right) : Perpendicular(up);
}

}  // namespace

Camera Fly(const Camera& camera, double forward, double right, double upward, const glm::dvec3& up) {
  const glm::dvec3 ahead = Normalized(ViewOf(camera));
  const Vec3 shift = ToEigen(forward * ahead + right * RightOf(ahead, up) + upward * up);
  Camera moved = camera;
  moved.eye += shift;
  moved.look_at += shift;
  return moved;
}

Camera Look(const Camera& camera, double right, double upward, const glm::dvec3& up) {
  const double distance = glm::length(ViewOf(camera));
  const glm::dvec3 ahead = ViewOf(camera) / distance;
  const double elevation = std::asin(std::clamp(glm::dot(ahead, up), -1.0, 1.0));
  const double raised = std::clamp(elevation + upward, -kSteepest, kSteepest);
  // Along the ground, where the view is not straight up or down.
  const glm::dvec3 level = glm::angleAxis(-right, up) * Normalized(glm::cross(up, RightOf(ahead, up)));
  Camera turned = camera;
  turned.look_at = camera.eye + ToEigen(distance * (std::cos(raised) * level + std::sin(raised) * up));
  turned.up = ToEigen(up);
  return turned;
}

}  // namespace penumbra::viewer
