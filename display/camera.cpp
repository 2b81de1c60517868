#include "display/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "solver/base/check.h"

namespace penumbra {
namespace {

// The sine of the angle to the view below which a direction cannot serve as `up`.
constexpr double kParallelSine = 1e-6;

struct Axes {
  Vec3 right, up, forward;
};

Axes CameraAxes(const Camera& camera) {
  const Vec3 forward = (camera.look_at - camera.eye).stableNormalized();
  for (const Vec3& up : {camera.up.stableNormalized().eval(), Vec3::UnitZ().eval(), Vec3::UnitY().eval()}) {
    if (!CanBeUp(up, camera)) continue;
    const Vec3 unit = forward.cross(up).normalized();
    return {unit, unit.cross(forward), forward};
  }
  PENUMBRA_CHECK(false && "no direction is parallel to both z and y");
  return {};
}

double HalfHeight(const Camera& camera) { return std::tan(camera.vertical_fov * (std::numbers::pi / 360)); }

}  // namespace

bool CanBeUp(const Vec3& up, const Camera& camera) {
  const Vec3 forward = (camera.look_at - camera.eye).stableNormalized();
  return forward.cross(up.stableNormalized()).norm() >= kParallelSine;
}

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
  rays.eye = camera.eye;
  rays.dx = pixel * axes.right;
  rays.dy = -pixel * axes.up;
  rays.corner = axes.forward - 0.5 * width * rays.dx - 0.5 * height * rays.dy;
  return rays;
}

Camera FrameScene(const Scene& scene) {
  const auto [low, high] = scene.Bounds();
  const Vec3 centre = 0.5 * (low + high);
  const Vec3 from = Vec3(0.45, -1, 0.75).normalized();
  Camera camera;
  camera.name = "framed";
  camera.look_at = centre;
  camera.eye = centre + from;
  const Axes axes = CameraAxes(camera);

  // The least distance from which each corner of the box is in the picture.
  const double half = HalfHeight(camera);
  double distance = 0;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner =
        Vec3((i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z()) - centre;
    const double across = std::max(std::abs(corner.dot(axes.right)), std::abs(corner.dot(axes.up)));
    distance = std::max(distance, across / half - corner.dot(axes.forward));
  }
  constexpr double kMargin = 1.04;
  camera.eye = centre + (distance > 0 ? kMargin * distance : 1.0) * from;
  return camera;
}

}  // namespace penumbra
