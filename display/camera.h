// display/camera.h
//
// Cameras as the display uses them: the ray through every point of the picture, in binary64, and a camera for
// scenes that bring none along.

#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "solver/scene/scene.h"

namespace penumbra {

// The pinhole camera of a picture. Picture coordinates are pixels: (0, 0) is the upper left corner of the
// picture, x runs right, y down, pixel (i, j) has its centre at (i + 1/2, j + 1/2). Pixels are square.
struct PixelRays {
  glm::dvec3 eye{0.0};
  glm::dvec3 corner{0.0};       // the direction through (0, 0); its component along the view axis is 1
  glm::dvec3 dx{0.0}, dy{0.0};  // its change per pixel

  // The direction through the point (x, y) of the picture; not unit: eye + z * Direction(x, y) has depth z
  // [m].
  glm::dvec3 Direction(double x, double y) const { return corner + x * dx + y * dy; }
};

// The way back, from vectors that begin at the eye to homogeneous picture coordinates (x, y, z): what lies
// there is seen at (x / z, y / z), z is its depth [m].
struct Projection {
  glm::dvec3 x{0.0}, y{0.0}, depth{0.0};

  // The last sum begins at its end. Its rounding is part of every picture: in another order some bytes of
  // pictures would change.
  glm::dvec3 operator()(const glm::dvec3& from_eye) const {
    return {glm::dot(x, from_eye), glm::dot(y, from_eye),
            depth.x * from_eye.x + (depth.y * from_eye.y + depth.z * from_eye.z)};
  }
};

// The rays of a picture of width x height pixels. An `up` that is zero or parallel to the view is replaced:
// by z, or by y where the camera looks along z. Throws InputError if the camera cannot see: see
// ValidateCamera. REQUIRES: width > 0, height > 0.
PixelRays MakePixelRays(const Camera& camera, int width, int height);

// What undoes PixelRays::Direction().
Projection MakeProjection(const PixelRays& rays);

// Throws InputError, with a line that says what to mend, unless eye, look_at, up and field of view are
// finite, eye and look_at differ, and the field of view lies strictly between 0 and 180 degrees.
bool CanBeUp(const Vec3& up, const Camera& camera);
void ValidateCamera(const Camera& camera);

// A camera for a scene without one: z up, looking down at the middle of the bounding box from outside, all of
// the box in any picture that is at least as wide as high. Back faces are culled, so that one looks into a
// closed room.
Camera FrameScene(const Scene& scene);

}  // namespace penumbra
