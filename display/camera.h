// display/camera.h
//
// Cameras as the display uses them: the ray through every point of the picture, in binary64, and a camera for
// scenes that bring none along.

#pragma once

#include "solver/scene/scene.h"

namespace penumbra {

// The pinhole camera of a picture. Picture coordinates are pixels: (0, 0) is the upper left corner of the
// picture, x runs right, y down, pixel (i, j) has its centre at (i + 1/2, j + 1/2). Pixels are square.
struct PixelRays {
  Vec3 eye = Vec3::Zero();
  Vec3 corner = Vec3::Zero();  // the direction through (0, 0); its component along the view axis is 1
  Vec3 dx = Vec3::Zero(), dy = Vec3::Zero();  // its change per pixel

  // The direction through the point (x, y) of the picture; not unit: eye + z * Direction(x, y) has depth z
  // [m].
  Vec3 Direction(double x, double y) const { return corner + x * dx + y * dy; }
};

// The rays of a picture of width x height pixels. An `up` that is zero or parallel to the view is replaced:
// by z, or by y where the camera looks along z. Throws InputError if the camera cannot see: see
// ValidateCamera. REQUIRES: width > 0, height > 0.
PixelRays MakePixelRays(const Camera& camera, int width, int height);

// Throws InputError, with a line that says what to mend, unless eye, look_at, up and field of view are
// finite, eye and look_at differ, and the field of view lies strictly between 0 and 180 degrees.
bool CanBeUp(const Vec3& up, const Camera& camera);
void ValidateCamera(const Camera& camera);

// A camera for a scene without one: z up, looking down at the middle of the bounding box from outside, all of
// the box in any picture that is at least as wide as high. Back faces are culled, so that one looks into a
// closed room.
Camera FrameScene(const Scene& scene);

}  // namespace penumbra
