#include "display/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "display/glm_conversion.h"
#include "display/unit_vectors.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

// The sine of the angle to the view below which a direction cannot serve as `up`.
constexpr double kParallelSine = 1e-6;

struct Axes {
  glm::dvec3 right, up, forward;
};

glm::dvec3 Forward(const Camera& camera) {
  return StableNormalized(ToGlm(camera.look_at) - ToGlm(camera.eye));
}

bool IsUpFor(const glm::dvec3& forward, const glm::dvec3& up) {
  return glm::length(glm::cross(forward, StableNormalized(up))) >= kParallelSine;
}

Axes CameraAxes(const Camera& camera) {
  const glm::dvec3 forward = Forward(camera);
  for (const glm::dvec3& up :
       {StableNormalized(ToGlm(camera.up)), glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0)}) {
    if (!IsUpFor(forward, up)) continue;
    const glm::dvec3 right = Normalized(glm::cross(forward, up));
    return {right, glm::cross(right, forward), forward};
  }
  PENUMBRA_CHECK(false && "no direction is parallel to both z and y");
  return {};
}

double HalfHeight(const Camera& camera) { return std::tan(camera.vertical_fov * (std::numbers::pi / 360)); }

}  // namespace

bool CanBeUp(const Vec3& up, const Camera& camera) { return IsUpFor(Forward(camera), ToGlm(up)); }

void ValidateCamera(const Camera& camera) {
  const std::string name = camera.name.empty() ? "camera" : fmt::format("camera '{}'", camera.name);
  if (!camera.eye.allFinite() || !camera.look_at.allFinite() || !camera.up.allFinite())
    throw InputError(fmt::format("{}: error: a coordinate is not finite; give numbers in metres", name));
  if (!(camera.look_at - camera.eye).allFinite())
    throw InputError(fmt::format("{}: error: eye and look-at are too far apart; move them closer", name));
  if (!((camera.look_at - camera.eye).stableNorm() > 0))
    throw InputError(fmt::format("{}: error: eye and look-at are the same point; move one of them", name));
  if (!(camera.vertical_fov > 0 && camera.vertical_fov < 180))
    throw InputError(fmt::format("{}: error: a field of view of {} degrees; give one between 0 and 180", name,
                                 camera.vertical_fov));
}

PixelRays MakePixelRays(const Camera& camera, int width, int height) {
  PENUMBRA_CHECK(width > 0 && height > 0);
  ValidateCamera(camera);
  const Axes axes = CameraAxes(camera);
  const double pixel = 2 * HalfHeight(camera) / height;
  PixelRays rays;
  rays.eye = ToGlm(camera.eye);
  rays.dx = pixel * axes.right;
  rays.dy = -pixel * axes.up;
  rays.corner = axes.forward - 0.5 * width * rays.dx - 0.5 * height * rays.dy;
  return rays;
}

Projection MakeProjection(const PixelRays& rays) {
  // The rows of the inverse of the matrix with the columns dx, dy and corner.
  const glm::dvec3 x = glm::cross(rays.dy, rays.corner), y = glm::cross(rays.corner, rays.dx),
                   depth = glm::cross(rays.dx, rays.dy);
  const double scale = 1 / glm::dot(rays.dx, x);
  return {x * scale, y * scale, depth * scale};
}

Camera FrameScene(const Scene& scene) {
  const auto bounds = scene.Bounds();
  const glm::dvec3 low = ToGlm(bounds.first), high = ToGlm(bounds.second);
  const glm::dvec3 centre = 0.5 * (low + high);
  const glm::dvec3 from = Normalized({0.45, -1, 0.75});
  Camera camera;
  camera.name = "framed";
  camera.look_at = ToEigen(centre);
  camera.eye = ToEigen(centre + from);
  const Axes axes = CameraAxes(camera);

  // The least distance from which each corner of the box is in the picture.
  const double half = HalfHeight(camera);
  double distance = 0;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner =
        glm::dvec3((i & 1 ? high : low).x, (i & 2 ? high : low).y, (i & 4 ? high : low).z) - centre;
    const double across =
        std::max(std::abs(glm::dot(corner, axes.right)), std::abs(glm::dot(corner, axes.up)));
    distance = std::max(distance, across / half - glm::dot(corner, axes.forward));
  }
  constexpr double kMargin = 1.04;
  camera.eye = ToEigen(centre + (distance > 0 ? kMargin * distance : 1.0) * from);
  return camera;
}

}  // namespace penumbra
