// display/camera.h
//
// Cameras: the ray through each point of a picture, in binary64, and a default camera for scenes that define
// no camera.

#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "solver/scene/scene.h"

namespace penumbra {

// The pinhole camera of a picture. Picture coordinates are in pixels: (0, 0) is the upper left corner of the
// picture, x increases to the right and y downwards, and pixel (i, j) has its centre at (i + 1/2, j + 1/2).
// Pixels are square.
struct PixelRays {
  glm::dvec3 eye{0.0};
  // The direction from the eye through picture point (0, 0), scaled to length 1 along the view axis.
  glm::dvec3 corner{0.0};
  // The change of the direction from one pixel to the next, to the right and downwards.
  glm::dvec3 dx{0.0}, dy{0.0};

  // The direction through the point (x, y) of the picture, scaled such that eye + z * Direction(x, y) has the
  // depth z [m].
  glm::dvec3 Direction(double x, double y) const { return corner + x * dx + y * dy; }
};

// The inverse of PixelRays::Direction(): maps a vector v that begins at the eye to homogeneous picture
// coordinates h. The point at the end of v appears at (h.x / h.z, h.y / h.z) in the picture, and has the
// depth h.z [m].
struct Projection {
  glm::dvec3 x{0.0}, y{0.0}, depth{0.0};

  // The depth is a sum of three terms; the last two terms are added first. Another order of the three terms
  // of the depth would round differently, and would change some bytes of pictures.
  glm::dvec3 operator()(const glm::dvec3& from_eye) const {
    return {glm::dot(x, from_eye), glm::dot(y, from_eye),
            depth.x * from_eye.x + (depth.y * from_eye.y + depth.z * from_eye.z)};
  }
};

// The rays of a picture of width x height pixels. If camera.up is zero or parallel to the view, the z axis
// replaces camera.up, or the y axis if the camera looks along z. Throws InputError if ValidateCamera()
// rejects the camera. REQUIRES: width > 0, height > 0.
PixelRays MakePixelRays(const Camera& camera, int width, int height);

// The projection that inverts rays.Direction(). REQUIRES: `rays` is a result of MakePixelRays().
Projection MakeProjection(const PixelRays& rays);

// True if `up` can serve as camera.up: `up` is neither zero nor parallel to the view.
bool CanBeUp(const Vec3& up, const Camera& camera);
// Throws InputError, with a line that says how to mend the camera, unless eye, look_at, up and field of view
// are finite, eye and look_at differ, and the field of view lies strictly between 0 and 180 degrees.
void ValidateCamera(const Camera& camera);

// A default camera for scenes that define no camera. The default camera is outside the scene, looks down at
// the centre of the scene's bounding box, and has z as the upward direction. The whole bounding box is
// visible in any picture that is at least as wide as high. Because back faces are culled, the default camera
// sees the inside of a closed room.
Camera FrameScene(const Scene& scene);

}  // namespace penumbra
